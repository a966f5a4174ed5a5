#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "cli/progress.hpp"
#include "cli/results.hpp"
#include "config/find_file.hpp"
#include "operator/operator_station.hpp"
#include "results/metrics/summary.hpp"
#include "runtime/program_bound.hpp"
#include "runtime/run.hpp"

namespace twin::cli {
namespace {

/// Runs with a progress bar, and on the wall clock with what an operator needs.
Expected<runtime::RunResult> run_with_operator(const Options& options,
                                               runtime::RunRequest& request) {
  runtime::OperatorPanel panel;
  std::unique_ptr<operator_station::OperatorStation> station;
  if (request.is_wall_clock) {
    auto opened = operator_station::OperatorStation::open(
        {.socket = options.control, .shows_status = !options.quiet}, panel);
    if (!opened) {
      return tl::unexpected(opened.error());
    }
    station = std::move(*opened);
    request.panel = &panel;
  } else if (!options.control.empty()) {
    return fail(ErrorCode::kUsage,
                "--control is for runs on the wall clock: --realtime or --hal rig; in simulated "
                "time there is --override");
  }
  const bool is_shown = station != nullptr && station->shows_status();
  Progress progress(request.hal != nullptr ? "machining" : "planning", options.quiet || is_shown);
  request.progress = progress.callback();
  request.estimated = [&progress](double time) {
    progress.rename(fmt::format("machining, {:.1f} s", time));
  };
  return runtime::run_program(request);
}

/// run and plan differ in the machine alone: null plans only.
Expected<void> execute(const Options& options, const std::atomic<bool>& stop, bool has_machine) {
  auto machine = read_machine(options);
  if (!machine) {
    return tl::unexpected(machine.error());
  }
  auto program = config::find_program(options.programs.front());
  if (!program) {
    return tl::unexpected(program.error());
  }
  std::vector<runtime::OverrideChange> overrides;
  if (!options.overrides.empty()) {
    auto schedule = runtime::parse_override_schedule(options.overrides);
    if (!schedule) {
      return tl::unexpected(schedule.error());
    }
    overrides = std::move(*schedule);
  }
  std::unique_ptr<hal::Machine> hal;
  if (has_machine) {
    auto opened = open_machine(options, *machine, "run " + program->filename().string());
    if (!opened) {
      return tl::unexpected(opened.error());
    }
    hal = std::move(*opened);
  }
  runtime::RunRequest request;
  request.program = *program;
  request.machine = *machine;
  request.hal = hal.get();
  request.feedrate = feedrate_of(options);
  request.directory = result_folder(options, *program);
  request.is_wall_clock = options.realtime || (hal && hal->info().keeps_own_time);
  request.stop = &stop;
  request.command = options.command;
  request.overrides = std::move(overrides);
  auto result = run_with_operator(options, request);
  if (!result) {
    return tl::unexpected(result.error());
  }
  if (options.bound && !result->failure) {
    auto bound = runtime::time_bound(*program, *machine, request.feedrate);
    if (!bound) {
      return tl::unexpected(bound.error());
    }
    result->summary.time_bound = *bound;
  }
  if (auto written = write_summary(request.directory, *result); !written) {
    return written;
  }
  if (!options.quiet) {
    fmt::print("{}", results::to_table(result->summary, machine->limits));
  }
  if (result->failure) {
    return tl::unexpected(*result->failure);
  }
  remove_stale_results(request.directory);
  const std::string title = options.feedrate_mm_per_min
                                ? fmt::format("{}, {:g} mm/min", program->filename().string(),
                                              *options.feedrate_mm_per_min)
                                : program->filename().string();
  if (!options.no_plots) {
    if (auto drawn = write_plots(request.directory, *program, title, !has_machine, options.quiet);
        !drawn) {
      return drawn;
    }
  }
  if (options.video) {
    if (auto rendered = write_video(request.directory, machine->table.model, title, options);
        !rendered) {
      return rendered;
    }
  }
  if (!options.quiet) {
    fmt::print("results in {}\n", request.directory.string());
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
