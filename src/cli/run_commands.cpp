#include <fmt/core.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "config/find_file.hpp"
#include "operator/operator_station.hpp"
#include "results/metrics/summary.hpp"
#include "runtime/program_check.hpp"
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
  TWIN_TRY(request.program, read_program(program.name, stop, results.folder));
  request.feedrate = program.feedrate;
  request.folder = results.folder;
  request.columns = results.columns;
  request.has_trace = results.has_trace;
  if (!overrides.empty()) {
    TWIN_TRY(request.overrides, runtime::parse_override_schedule(overrides));
  }
  return request;
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
  return session.run(attendance);
}

/// Page and plots of a run that ended early; what fails here is not said, because why the run ended
/// is what matters. A user who interrupts does not wait for plots.
void show_what_was_done(const session::Session& session, const Error& why,
                        const ResultArguments& results) {
  if (!results.has_trace) {
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
    print_out("{}", results::to_table(result.summary, session.machine().limits));
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
  if (results.has_page && results.has_trace) {
    TWIN_CHECK(session.write_report());
  }
  if (results.has_plots && results.has_trace) {
    Progress progress("plots", results.verbosity);
    progress.show(0.0);
    TWIN_CHECK(session.draw_figures());
  }
  if (video.is_wanted) {
    Progress progress("video", results.verbosity);
    TWIN_CHECK(session.render_video(video.camera, progress.callback()));
  }
  if (results.verbosity == Verbosity::kNormal && !results.has_json) {
    const bool has_page = results.has_page && results.has_trace;
    print_out("results in {}{}\n", session.folder().string(),
              has_page ? "; look at report.html" : "");
  }
  return {};
}

}  // namespace

Expected<void> execute(const RunArguments& arguments, const Environment& environment) {
  TWIN_TRY(session::Request request,
           request_of(arguments.program, arguments.machine, arguments.overrides, arguments.results,
                      environment.stop));
  request.command = environment.command_line;
  request.make_machine = machine_of(arguments.hal);
  request.pace = arguments.is_on_wall_clock ? session::Pace::kWallClock : session::Pace::kOwn;
  TWIN_TRY(session::Session session, session::Session::open(std::move(request)));
  TWIN_TRY(const runtime::RunResult result, run_with_operator(session, arguments.results.verbosity,
                                                              arguments.control, environment.stop));
  TWIN_CHECK(report_run(session, result, arguments.results));
  return make_pictures(session, arguments.results, arguments.video);
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

namespace {

/// Words of a command line as it is quoted for a shell, without quotation marks.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words(1);
  bool is_quoted = false;
  for (const char c : command) {
    if (c == '\'') {
      is_quoted = !is_quoted;
    } else if (c == ' ' && !is_quoted) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

/// The program of a trace, where it is still there and still the same: by its name, or by the path
/// that the command line of the run had.
std::optional<gcode::ProgramText> program_of(const session::TraceOrigin& origin,
                                             const std::atomic<bool>& stop) {
  std::vector<std::string> names{origin.program};
  for (const std::string& word : words_of(origin.command)) {
    const std::filesystem::path file(word);
    if (file.filename() == origin.program || file.stem() == origin.program) {
      names.push_back(word);
    }
  }
  for (const std::string& name : names) {
    auto program = read_program(name, stop);
    if (program && program->sha256() == origin.program_sha256) {
      return *std::move(program);
    }
  }
  return std::nullopt;
}

}  // namespace

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
    TWIN_CHECK(
        session::draw_figures({arguments.folder, program_of(origin, environment.stop),
                               origin.program, origin.kind, origin.trace.filename().string()}));
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

// Check.

namespace {

Expected<void> check_program_of(const std::string& name, const CheckArguments& arguments,
                                const config::MachineFile& machine, const std::atomic<bool>& stop) {
  TWIN_TRY(const gcode::ProgramText program, read_program(name, stop));
  gcode::ReaderOptions reading;
  reading.feedrate = arguments.feedrate;
  TWIN_TRY(const runtime::Estimate estimate,
           runtime::estimate_program(program, reading, machine, &stop));
  if (arguments.verbosity == Verbosity::kNormal) {
    const runtime::ProgramFigures& figures = estimate.program;
    print_out(
        "{}: {} blocks, {:.3f} mm, X {:g} .. {:g}, Y {:g} .. {:g}, Z {:g} .. {:g} mm, "
        "cycle time {:.3f} s\n",
        program.file().string(), figures.blocks, figures.length, figures.box_min.x(),
        figures.box_max.x(), figures.box_min.y(), figures.box_max.y(), figures.box_min.z(),
        figures.box_max.z(), estimate.plan.time);
  }
  return {};
}

}  // namespace

/// Checks all the programs, so that one call shows what is wrong with each.
Expected<void> execute(const CheckArguments& arguments, const Environment& environment) {
  TWIN_TRY(const auto machine, read_machine(arguments.machine, arguments.verbosity));
  Expected<void> result;
  for (const std::string& name : arguments.programs) {
    if (auto checked = check_program_of(name, arguments, machine, environment.stop); !checked) {
      if (!result) {
        print_error(result.error());
      }
      result = checked;
    }
  }
  return result;
}

// Help and version.

Expected<void> execute(const TextArguments& arguments, const Environment&) {
  print_out("{}", arguments.text);
  return {};
}

}  // namespace twin::cli
