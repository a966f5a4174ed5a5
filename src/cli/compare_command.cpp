#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "cli/progress.hpp"
#include "compare/texts.hpp"
#include "compare/write_results.hpp"
#include "config/find_file.hpp"

namespace twin::cli {
namespace {

/// The curve on which parameter updates are usually judged, where it is there.
constexpr const char* kCurveProgram = "butterfly_nurbs.nc";

Expected<compare::Request> request_of(const Options& options) {
  auto machine = config::find_machine(options.machine);
  auto program = config::find_program(options.programs.front());
  if (!machine || !program) {
    return tl::unexpected(!machine ? machine.error() : program.error());
  }
  compare::Request request;
  request.program = *program;
  request.machine_file = *machine;
  request.settings = options.settings;
  request.feedrate = feedrate_of(options);
  request.running.make_machine = [hal = options.hal](const config::MachineFile& file) {
    return make_machine(hal, file);
  };
  if (auto curve = config::find_program(kCurveProgram);
      curve && curve->filename() != program->filename()) {
    request.curve_programs.push_back(*curve);
  }
  return request;
}

Expected<void> compare_command(const Options& options, const std::atomic<bool>& stop) {
  auto request = request_of(options);
  if (!request) {
    return tl::unexpected(request.error());
  }
  const std::filesystem::path out =
      options.out.empty()
          ? std::filesystem::path("renders") / (request->program.stem().string() + "_compare")
          : options.out;
  auto workshop = report::Workshop::open(out);
  if (!workshop) {
    return tl::unexpected(workshop.error());
  }
  request->folder = workshop->folder();
  request->running.stop = &stop;
  Expected<compare::Comparison> comparison;
  {
    Progress progress("comparing", options.quiet);
    request->running.progress = progress.callback();
    comparison = compare::compare(*request);
  }
  if (!comparison) {
    return tl::unexpected(comparison.error());
  }
  {
    Progress progress("plots", options.quiet || options.no_plots);
    progress.show(0.0);
    if (auto written = write_results(*comparison, *workshop, !options.no_plots); !written) {
      return written;
    }
  }
  if (!options.quiet) {
    fmt::print("{}\n", to_text(grid_of_interpolators(*comparison)));
    if (!comparison->fluctuations.empty()) {
      fmt::print("{}\n", to_text(grid_of_fluctuations(*comparison)));
    }
    fmt::print("results in {}\n", out.string());
  }
  return {};
}

}  // namespace

Command add_compare(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "compare", "The interpolators side by side on one program; the parameter updates too");
  add_program_options(*app, options);
  add_machine_options(*app, options);
  add_hal_option(*app, options);
  add_result_options(*app, options, "PROGRAM_compare");
  return {app, [&options, &stop = context.stop] { return compare_command(options, stop); }};
}

}  // namespace twin::cli
