#include <fmt/core.h>

#include <memory>
#include <utility>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "config/find_file.hpp"
#include "operator/operator_station.hpp"
#include "results/metrics/summary.hpp"
#include "runtime/program_check.hpp"
#include "session/pictures.hpp"
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

/// Prints what a run has shown, and hands on why it ended early.
Expected<void> report_run(const session::Session& session, const runtime::RunResult& result,
                          Verbosity verbosity) {
  if (verbosity == Verbosity::kNormal) {
    print_out("{}", results::to_table(result.summary, session.machine().limits));
  }
  return result.failure ? tl::unexpected(*result.failure) : Expected<void>();
}

/// Plots and video of what has been run, and where they are.
Expected<void> make_pictures(const session::Session& session, const ResultArguments& results,
                             const VideoArguments& video) {
  if (results.has_plots) {
    Progress progress("plots", results.verbosity);
    progress.show(0.0);
    TWIN_CHECK(session.draw_figures());
  }
  if (video.is_wanted) {
    Progress progress("video", results.verbosity);
    TWIN_CHECK(session.render_video(video.camera, progress.callback()));
  }
  if (results.verbosity == Verbosity::kNormal) {
    print_out("results in {}\n", session.folder().string());
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
  TWIN_CHECK(report_run(session, result, arguments.results.verbosity));
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
  TWIN_CHECK(report_run(session, result, arguments.results.verbosity));
  return make_pictures(session, arguments.results, {});
}

// Render.

namespace {

/// The program of a trace, where it is still there and still the same.
std::optional<gcode::ProgramText> program_of(const session::TraceOrigin& origin,
                                             const std::atomic<bool>& stop) {
  auto program = read_program(origin.program, stop);
  const bool is_same = program && program->sha256() == origin.program_sha256;
  return is_same ? std::optional(*std::move(program)) : std::nullopt;
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
    TWIN_CHECK(session::draw_figures(
        {arguments.folder, program_of(origin, environment.stop), origin.program, origin.kind}));
  }
  if (arguments.video.is_wanted) {
    Progress progress("video", arguments.verbosity);
    TWIN_CHECK(session::render_video({arguments.folder, machine.table.model, origin.program,
                                      arguments.video.camera, progress.callback()}));
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
