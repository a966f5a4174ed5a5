#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "cli/progress.hpp"
#include "config/find_file.hpp"
#include "studies/compare/comparison_files.hpp"
#include "studies/compare/planner_table.hpp"

namespace twin::cli {
namespace {

/// The curve on which parameter updates are usually judged, where it is there.
constexpr const char* kCurveProgram = "butterfly_nurbs.nc";

/// Files of the programs named.
Expected<std::vector<std::filesystem::path>> find_programs(const Options& options) {
  std::vector<std::filesystem::path> programs;
  for (const std::string& name : options.programs) {
    auto program = config::find_program(name);
    if (!program) {
      return tl::unexpected(std::move(program.error()));
    }
    programs.push_back(std::move(*program));
  }
  return programs;
}

Expected<studies::compare::Request> request_of(const Options& options,
                                               const std::filesystem::path& program) {
  auto machine = config::find_machine(options.machine);
  if (!machine) {
    return tl::unexpected(std::move(machine.error()));
  }
  studies::compare::Request request;
  request.program = program;
  request.machine_file = *machine;
  request.settings = options.settings;
  request.feedrate = feedrate_of(options);
  request.running.make_machine = [hal = options.hal](const config::MachineFile& file) {
    return make_machine(hal, file);
  };
  if (auto curve = config::find_program(kCurveProgram);
      curve && curve->filename() != program.filename()) {
    request.curve_programs.push_back(*curve);
  }
  return request;
}

/// One program: the contestants, with runs.
Expected<void> compare_contestants(const Options& options, studies::compare::Request request,
                                   const pictures::Workshop& workshop) {
  Expected<studies::compare::Comparison> comparison;
  {
    Progress progress("comparing", options.quiet);
    request.running.progress = progress.callback();
    comparison = studies::compare::compare(request);
  }
  if (!comparison) {
    return tl::unexpected(comparison.error());
  }
  {
    Progress progress("plots", options.quiet || options.no_plots);
    progress.show(0.0);
    TWIN_CHECK(
        write_results(*comparison, workshop,
                      options.no_plots ? pictures::Drawing::kLeftOut : pictures::Drawing::kDrawn));
  }
  if (!options.quiet) {
    fmt::print("{}\n", to_text(grid_of_interpolators(*comparison)));
    if (!comparison->fluctuations.empty()) {
      fmt::print("{}\n", to_text(grid_of_fluctuations(*comparison)));
    }
  }
  return {};
}

/// Several programs: a table of the planners, without runs.
Expected<void> compare_planners(const Options& options, studies::compare::Request request,
                                const std::vector<std::filesystem::path>& programs,
                                const pictures::Workshop& workshop) {
  Expected<std::vector<studies::compare::PlannerRow>> rows;
  {
    Progress progress("planning", options.quiet);
    request.running.progress = progress.callback();
    rows = studies::compare::planner_rows(request, programs);
  }
  if (!rows) {
    return tl::unexpected(rows.error());
  }
  if (auto written = write_planner_table(*rows, workshop); !written) {
    return written;
  }
  if (!options.quiet) {
    fmt::print("{}\n", to_text(grid_of_planners(*rows)));
  }
  return {};
}

Expected<void> compare_command(const Options& options, const std::atomic<bool>& stop) {
  const auto programs = find_programs(options);
  if (!programs) {
    return tl::unexpected(programs.error());
  }
  auto request = request_of(options, programs->front());
  if (!request) {
    return tl::unexpected(request.error());
  }
  const bool is_one = programs->size() == 1;
  const std::filesystem::path name =
      is_one ? request->program.stem().string() + "_compare" : "compare";
  const std::filesystem::path out =
      options.out.empty() ? std::filesystem::path("renders") / name : options.out;
  const auto workshop = pictures::Workshop::open(out);
  if (!workshop) {
    return tl::unexpected(workshop.error());
  }
  request->folder = workshop->folder();
  request->running.stop = &stop;
  const auto compared = is_one ? compare_contestants(options, *request, *workshop)
                               : compare_planners(options, *request, *programs, *workshop);
  if (!compared) {
    return compared;
  }
  if (!options.quiet) {
    fmt::print("results in {}\n", out.string());
  }
  return {};
}

}  // namespace

Command add_compare(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "compare",
      "Planners and interpolators side by side on one program, the parameter updates too; "
      "a table of the planners for several programs");
  app->add_option("program", options.programs,
                  "NC programs: files, or names of some in nc_programs; more than one are planned "
                  "only, a line each program and planner")
      ->required()
      ->type_name("PROGRAM.nc");
  add_feedrate_option(*app, options);
  add_machine_options(*app, options);
  add_hal_option(*app, options);
  add_result_options(*app, options, "PROGRAM_compare");
  return {app, [&options, &stop = context.stop] { return compare_command(options, stop); }};
}

}  // namespace twin::cli
