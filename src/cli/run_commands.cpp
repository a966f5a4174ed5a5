#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "cli/run_command.hpp"
#include "cli/shadowed_run.hpp"
#include "config/find_file.hpp"
#include "hal/linuxcnc/linuxcnc_machine.hpp"
#include "live/live_view.hpp"
#include "live/publisher.hpp"
#include "operator/operator_station.hpp"
#include "results/metrics/summary.hpp"
#include "runtime/run_options.hpp"
#include "session/pictures.hpp"
#include "session/report.hpp"
#include "session/session.hpp"

// The commands that read a program, run it and show what came of it; and help.
namespace twin::cli {

// Run and plan.

namespace {

/// What run and plan have in common.
Expected<session::Request> request_of(const ProgramArguments& program,
                                      const MachineArguments& machine, const std::string& overrides,
                                      const ResultArguments& results,
                                      const std::atomic<bool>& stop) {
  session::Request request;
  TWIN_TRY(request.machine, read_machine(machine, results.verbosity));
  TWIN_TRY(request.program, read_program(program.name, machine, stop, results.folder));
  request.feedrate = program.feedrate;
  request.folder = results.folder;
  request.columns = results.columns;
  request.trace = results.trace;
  if (!overrides.empty()) {
    TWIN_TRY(request.overrides, runtime::parse_override_schedule(overrides));
  }
  return request;
}

/// Notes in one line, as in "dolphin.nc: 3 notes (tool, message), which twin check shows".
std::string summary_of(const std::vector<gcode::Note>& notes, const std::string& program) {
  std::set<std::string> kinds;
  for (const gcode::Note& note : notes) {
    std::string kind(name_of(note.kind));
    std::ranges::replace(kind, '_', ' ');
    kinds.insert(std::move(kind));
  }
  return fmt::format("{}: {} {} ({}); twin check shows {}", program, notes.size(),
                     notes.size() == 1 ? "note" : "notes", fmt::join(kinds, ", "),
                     notes.size() == 1 ? "it" : "them");
}

/// Hands what LinuxCNC's pins ask for to the panel, whenever it changes; nothing for other machines.
std::jthread watch_feed_pins(const hal::Machine* machine, runtime::OperatorPanel& panel) {
  const auto* const behind = dynamic_cast<const hal::linuxcnc::LinuxCncMachine*>(machine);
  if (behind == nullptr) {
    return {};
  }
  return std::jthread([behind, &panel](const std::stop_token& stop) {
    hal::linuxcnc::FeedWish last;
    for (; !stop.stop_requested(); std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
      const hal::linuxcnc::FeedWish wish = behind->feed_wish();
      if (wish.is_held != last.is_held) {
        panel.hold(wish.is_held);
      }
      if (wish.percent != last.percent) {
        panel.set_override(wish.percent);
      }
      last = wish;
    }
  });
}

/// Runs with a progress bar, and on the wall clock with what an operator needs.
///
/// @param control  socket for an operator; empty: none
Expected<runtime::RunResult> run_with_operator(session::Session& session, Verbosity verbosity,
                                               const std::filesystem::path& control,
                                               const std::atomic<bool>& stop) {
  session::Attendance attendance;
  attendance.stop = &stop;
  runtime::OperatorPanel panel;
  std::unique_ptr<operator_station::OperatorStation> station;
  if (session.is_on_wall_clock()) {
    TWIN_TRY(station,
             operator_station::OperatorStation::open(
                 {.socket = control, .shows_status = verbosity == Verbosity::kNormal}, panel));
    attendance.panel = &panel;
  } else if (!control.empty()) {
    return fail(ErrorCode::kUsage,
                "--control is for runs on the wall clock: --realtime or --hal rig; in simulated "
                "time there is --override");
  }
  const bool is_shown = station != nullptr && station->shows_status();
  Progress progress(session.hal() != nullptr ? "machining" : "planning",
                    is_shown ? Verbosity::kQuiet : verbosity);
  attendance.progress = progress.callback();
  attendance.estimated = [&progress](double time) {
    progress.rename(fmt::format("machining, {:.1f} s", time));
  };
  if (verbosity == Verbosity::kNormal) {
    attendance.noted = [&session](const std::vector<gcode::Note>& notes) {
      print_note(summary_of(notes, session.program().string()));
    };
  }
  const std::jthread pins = watch_feed_pins(session.hal(), panel);
  return session.run(attendance);
}

/// Page and plots of a run that ended early; what fails here is not said, because why the run ended
/// is what matters. A user who interrupts does not wait for plots.
void show_what_was_done(const session::Session& session, const Error& why,
                        const ResultArguments& results) {
  if (results.trace == results::TraceFiles::kNone) {
    return;
  }
  if (results.has_page) {
    static_cast<void>(session.write_report());
  }
  if (results.has_plots && why.code != ErrorCode::kInterrupted) {
    static_cast<void>(session.draw_figures());
  }
}

/// Prints what a run has shown, and hands on why it ended early.
Expected<void> report_run(const session::Session& session, const runtime::RunResult& result,
                          const ResultArguments& results) {
  if (results.has_json) {
    print_out("{}", results::to_json(result.summary));
  } else if (results.verbosity == Verbosity::kNormal) {
    put_out(with_bold_headings(results::to_table(result.summary, session.machine().limits)));
  }
  if (!result.failure) {
    return {};
  }
  show_what_was_done(session, *result.failure, results);
  return tl::unexpected(*result.failure);
}

/// What the chosen columns suffice for; a note says what is left out.
void leave_out_pictures(ResultArguments& results) {
  const std::string columns = "," + results.columns + ",";
  const auto has = [&columns](const char* name) {
    return columns.find("," + std::string(name) + ",") != std::string::npos;
  };
  if (results.columns.empty() || has("default") || has("all")) {
    return;
  }
  const bool has_page = has("t_s") && has("x_cmd_mm") && has("y_cmd_mm");
  if (results.verbosity == Verbosity::kNormal && (results.has_plots || results.has_page)) {
    print_note(has_page ? "no plots: they need the default columns"
                        : "no plots and no report: they need the default columns");
  }
  results.has_plots = false;
  results.has_page = results.has_page && has_page;
}

/// Page, plots and video of what has been run, and where they are.
Expected<void> make_pictures(const session::Session& session, ResultArguments results,
                             const VideoArguments& video) {
  leave_out_pictures(results);
  const bool has_trace = results.trace != results::TraceFiles::kNone;
  if (results.has_page && has_trace) {
    TWIN_CHECK(session.write_report());
  }
  if (results.has_plots && has_trace) {
    Progress progress("plots", results.verbosity);
    progress.show(0.0);
    TWIN_CHECK(session.draw_figures(results.paper));
  }
  if (video.is_wanted) {
    Progress progress("video", results.verbosity);
    TWIN_CHECK(session.render_video(video.camera, progress.callback()));
  }
  if (results.verbosity == Verbosity::kNormal && !results.has_json) {
    const bool has_page = results.has_page && has_trace;
    print_out("results in {}{}\n", session.folder().string(),
              has_page ? "; look at report.html" : "");
  }
  return {};
}

}  // namespace

namespace {

/// Whoever gets the rows of a run besides its trace.
struct Audience {
  std::unique_ptr<live::LiveView> view;
  std::unique_ptr<live::Publisher> publisher;
};

Expected<Audience> invite(const RunArguments& arguments, session::Session& session) {
  Audience audience;
  if (arguments.view) {
    if (!session.is_on_wall_clock()) {
      return fail(ErrorCode::kUsage,
                  "--view is for runs on the wall clock: --realtime or --hal rig; in simulated "
                  "time there is report.html afterwards");
    }
    const hal::MachineInfo& info = session.hal()->info();
    TWIN_TRY(audience.view,
             live::open_live_view({session.text(), session.machine(), info.name, info.simulated},
                                  *arguments.view));
    session.add_sink(*audience.view);
    print_note("look at " + audience.view->address());
  }
  if (!arguments.publish.empty()) {
    TWIN_TRY(audience.publisher, live::Publisher::open(arguments.publish));
    session.add_sink(*audience.publisher);
  }
  return audience;
}

}  // namespace

bool needs_studies(const RunArguments& arguments) {
  return arguments.correction.is_wanted || !arguments.correction.learning.empty() ||
         arguments.tolerance.has_value();
}

Expected<void> run_program(const RunArguments& arguments, const Environment& environment,
                           RunCompanion& companion) {
  TWIN_TRY(session::Request request,
           request_of(arguments.program, arguments.machine, arguments.overrides, arguments.results,
                      environment.stop));
  request.command = environment.command_line;
  request.make_machine = machine_of(arguments.hal, arguments.correction.plant);
  TWIN_CHECK(companion.prepare(request));
  request.pace = arguments.is_on_wall_clock ? session::Pace::kWallClock : session::Pace::kOwn;
  TWIN_TRY(session::Session session, session::Session::open(std::move(request)));
  TWIN_TRY(const Audience audience, invite(arguments, session));
  TWIN_TRY(const ShadowedRun shadowed,
           ShadowedRun::open(arguments.shadow, arguments.results.verbosity, session));
  TWIN_TRY(const runtime::RunResult result, run_with_operator(session, arguments.results.verbosity,
                                                              arguments.control, environment.stop));
  TWIN_CHECK(companion.finish(result));
  TWIN_CHECK(shadowed.finish(session));
  TWIN_CHECK(report_run(session, result, arguments.results));
  return make_pictures(session, arguments.results, arguments.video);
}

Expected<void> execute(const RunArguments& arguments, const Environment& environment) {
  RunCompanion none;
  return run_program(arguments, environment, none);
}

Expected<void> execute(const PlanArguments& arguments, const Environment& environment) {
  TWIN_TRY(session::Request request,
           request_of(arguments.program, arguments.machine, arguments.overrides, arguments.results,
                      environment.stop));
  request.command = environment.command_line;
  request.has_bound = arguments.has_bound;
  TWIN_TRY(session::Session session, session::Session::open(std::move(request)));
  TWIN_TRY(const runtime::RunResult result,
           run_with_operator(session, arguments.results.verbosity, {}, environment.stop));
  TWIN_CHECK(report_run(session, result, arguments.results));
  return make_pictures(session, arguments.results, {});
}

// Render.

Expected<void> execute(const RenderArguments& arguments, const Environment& environment) {
  TWIN_TRY(const session::TraceOrigin origin, session::read_origin(arguments.folder));
  if (arguments.video.is_wanted && origin.kind == session::TraceKind::kPlan) {
    return fail(ErrorCode::kUsage,
                "--video needs the trace of a run; this one is of a plan, without a machine");
  }
  TWIN_TRY(const auto machine, read_machine(arguments.machine, arguments.verbosity));
  if (arguments.has_plots) {
    Progress progress("plots", arguments.verbosity);
    progress.show(0.0);
    TWIN_CHECK(session::draw_figures({arguments.folder, program_of(origin, environment.stop),
                                      origin.program, origin.kind, origin.trace.filename().string(),
                                      origin.reading, arguments.paper}));
  }
  if (arguments.video.is_wanted) {
    Progress progress("video", arguments.verbosity);
    TWIN_CHECK(session::render_video({arguments.folder, machine.table.model, origin.program,
                                      arguments.video.camera, progress.callback(),
                                      origin.trace.filename().string()}));
  }
  return {};
}

// Report.

Expected<void> execute(const ReportArguments& arguments, const Environment& environment) {
  std::filesystem::path file = arguments.file;
  if (file.empty()) {
    file = (arguments.folders.size() == 1 ? arguments.folders.front()
                                          : std::filesystem::path("renders")) /
           session::kReportName;
  }
  TWIN_CHECK(session::write_report(
      arguments.folders,
      [&](const session::TraceOrigin& origin) { return program_of(origin, environment.stop); },
      file));
  if (arguments.verbosity == Verbosity::kNormal) {
    print_out("{}\n", file.string());
  }
  return {};
}

// Help and version.

Expected<void> execute(const TextArguments& arguments, const Environment&) {
  put_out(with_bold_headings(arguments.text));
  return {};
}

}  // namespace twin::cli
