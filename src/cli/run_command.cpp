#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "cli/progress.hpp"
#include "operator/operator_station.hpp"
#include "results/metrics/summary.hpp"
#include "session/session.hpp"

namespace twin::cli {
namespace {

/// Runs with a progress bar, and on the wall clock with what an operator needs.
Expected<runtime::RunResult> run_with_operator(session::Session& session, const Options& options,
                                               const std::atomic<bool>& stop) {
  session::Attendance attendance;
  attendance.stop = &stop;
  runtime::OperatorPanel panel;
  std::unique_ptr<operator_station::OperatorStation> station;
  if (session.is_on_wall_clock()) {
    TWIN_TRY(station, operator_station::OperatorStation::open(
                          {.socket = options.control, .shows_status = !options.quiet}, panel));
    attendance.panel = &panel;
  } else if (!options.control.empty()) {
    return fail(ErrorCode::kUsage,
                "--control is for runs on the wall clock: --realtime or --hal rig; in simulated "
                "time there is --override");
  }
  const bool is_shown = station != nullptr && station->shows_status();
  Progress progress(session.hal() != nullptr ? "machining" : "planning", options.quiet || is_shown);
  attendance.progress = progress.callback();
  attendance.estimated = [&progress](double time) {
    progress.rename(fmt::format("machining, {:.1f} s", time));
  };
  return session.run(attendance);
}

/// Plots and video of what has been run.
Expected<void> make_pictures(const session::Session& session, const Options& options) {
  if (!options.no_plots) {
    Progress progress("plots", options.quiet);
    progress.show(0.0);
    TWIN_CHECK(session.draw_figures());
  }
  if (options.video) {
    Progress progress("video", options.quiet);
    TWIN_CHECK(session.render_video(options.camera, progress.callback()));
  }
  return {};
}

/// run and plan differ in the machine alone: null plans only.
Expected<void> execute(const Options& options, const std::atomic<bool>& stop, bool has_machine) {
  session::Request request;
  TWIN_TRY(request.machine, read_machine(options));
  request.program = options.programs.front();
  request.feedrate = feedrate_of(options);
  request.folder = options.out;
  request.pace = options.realtime ? session::Pace::kWallClock : session::Pace::kOwn;
  request.has_bound = options.bound;
  if (!options.overrides.empty()) {
    TWIN_TRY(request.overrides, runtime::parse_override_schedule(options.overrides));
  }
  if (has_machine) {
    request.make_machine = [&options](const config::MachineFile& machine,
                                      const std::string& purpose) {
      return open_machine(options, machine, purpose);
    };
  }
  TWIN_TRY(session::Session session, session::Session::open(std::move(request)));
  TWIN_TRY(const runtime::RunResult result, run_with_operator(session, options, stop));
  if (!options.quiet) {
    fmt::print("{}", results::to_table(result.summary, session.machine().limits));
  }
  if (result.failure) {
    return tl::unexpected(*result.failure);
  }
  TWIN_CHECK(make_pictures(session, options));
  if (!options.quiet) {
    fmt::print("results in {}\n", session.folder().string());
  }
  return {};
}

}  // namespace

Command add_run(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "run", "Plan a program, move the machine along it, write the results, print the summary");
  add_program_options(*app, options);
  add_machine_options(*app, options);
  add_interpolator_option(*app, options);
  add_override_option(*app, options);
  add_hal_option(*app, options, true);
  add_rig_options(*app, options, true);
  app->add_flag("--realtime", options.realtime,
                "Keep to the wall clock; keys: + - 0 to 9 feed override, space feed hold");
  add_control_option(*app, options);
  add_result_options(*app, options);
  add_video_options(*app, options);
  return {app, [&options, &stop = context.stop] { return execute(options, stop, true); }};
}

Command add_plan(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "plan", "The same without a machine: set points, planned time, limits");
  add_program_options(*app, options);
  add_machine_options(*app, options);
  add_interpolator_option(*app, options);
  app->add_flag("--bound", options.bound,
                "The lower bound of the time as well: the same path without jerk limit");
  add_override_option(*app, options);
  add_result_options(*app, options);
  return {app, [&options, &stop = context.stop] { return execute(options, stop, false); }};
}

}  // namespace twin::cli
