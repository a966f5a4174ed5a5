#include <fmt/core.h>

#include "cli/commands.hpp"
#include "config/find_file.hpp"
#include "session/machine.hpp"
#include "session/results.hpp"
#include "studies/compare/comparison_files.hpp"
#include "studies/compare/planner_table.hpp"

namespace twin::cli {
namespace {

/// The curve on which parameter updates are usually judged, where it is there.
constexpr const char* kCurveProgram = "butterfly_nurbs.nc";

/// Files of the programs named.
Expected<std::vector<std::filesystem::path>> find_programs(const std::vector<std::string>& names) {
  std::vector<std::filesystem::path> programs;
  for (const std::string& name : names) {
    TWIN_TRY(std::filesystem::path program, config::find_program(name));
    programs.push_back(std::move(program));
  }
  return programs;
}

Expected<studies::compare::Request> request_of(const CompareArguments& arguments,
                                               const std::filesystem::path& program) {
  studies::compare::Request request;
  TWIN_TRY(request.machine_file, config::find_machine(arguments.machine.file));
  request.program = program;
  request.settings = arguments.machine.settings;
  request.feedrate = arguments.feedrate;
  request.running.make_machine = [hal = arguments.hal](const config::MachineFile& file) {
    return *session::make_simulated_machine(hal, file);
  };
  if (auto curve = config::find_program(kCurveProgram);
      curve && curve->filename() != program.filename()) {
    request.curve_programs.push_back(*curve);
  }
  return request;
}

/// One program: the contestants, with runs.
Expected<void> compare_contestants(const ResultArguments& results,
                                   studies::compare::Request request,
                                   const pictures::Workshop& workshop) {
  Expected<studies::compare::Comparison> comparison;
  {
    Progress progress("comparing", results.verbosity);
    request.running.progress = progress.callback();
    comparison = studies::compare::compare(request);
  }
  if (!comparison) {
    return tl::unexpected(comparison.error());
  }
  {
    Progress progress("plots", results.has_plots ? results.verbosity : Verbosity::kQuiet);
    progress.show(0.0);
    TWIN_CHECK(
        write_results(*comparison, workshop,
                      results.has_plots ? pictures::Drawing::kDrawn : pictures::Drawing::kLeftOut));
  }
  if (results.verbosity == Verbosity::kNormal) {
    fmt::print("{}\n", to_text(grid_of_interpolators(*comparison)));
    if (!comparison->fluctuations.empty()) {
      fmt::print("{}\n", to_text(grid_of_fluctuations(*comparison)));
    }
  }
  return {};
}

/// Several programs: a table of the planners, without runs.
Expected<void> compare_planners(const ResultArguments& results, studies::compare::Request request,
                                const std::vector<std::filesystem::path>& programs,
                                const pictures::Workshop& workshop) {
  Expected<std::vector<studies::compare::PlannerRow>> rows;
  {
    Progress progress("planning", results.verbosity);
    request.running.progress = progress.callback();
    rows = studies::compare::planner_rows(request, programs);
  }
  if (!rows) {
    return tl::unexpected(rows.error());
  }
  TWIN_CHECK(write_planner_table(*rows, workshop));
  if (results.verbosity == Verbosity::kNormal) {
    fmt::print("{}\n", to_text(grid_of_planners(*rows)));
  }
  return {};
}

}  // namespace

Expected<void> execute(const CompareArguments& arguments, const Environment& environment) {
  TWIN_TRY(const auto programs, find_programs(arguments.programs));
  TWIN_TRY(studies::compare::Request request, request_of(arguments, programs.front()));
  const bool is_one = programs.size() == 1;
  const std::filesystem::path out = session::result_folder(
      arguments.results.folder,
      is_one ? request.program.stem().string() + "_compare" : std::string("compare"));
  TWIN_TRY(const auto workshop, pictures::Workshop::open(out));
  request.folder = workshop.folder();
  request.running.stop = &environment.stop;
  TWIN_CHECK(is_one ? compare_contestants(arguments.results, request, workshop)
                    : compare_planners(arguments.results, request, programs, workshop));
  if (arguments.results.verbosity == Verbosity::kNormal) {
    fmt::print("results in {}\n", out.string());
  }
  return {};
}

}  // namespace twin::cli
