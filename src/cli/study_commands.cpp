#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>

#include "cli/compare_linuxcnc.hpp"
#include "cli/compare_runs.hpp"
#include "cli/machines.hpp"
#include "cli/study_commands.hpp"
#include "config/find_file.hpp"
#include "config/nearest_name.hpp"
#include "core/atomic_file.hpp"
#include "runtime/run_options.hpp"
#include "session/machine.hpp"
#include "session/results.hpp"
#include "studies/circular/circle_test.hpp"
#include "studies/compare/comparison_files.hpp"
#include "studies/compare/planner_table.hpp"
#include "studies/convert/checked_conversion.hpp"
#include "studies/convert/dialect.hpp"
#include "studies/reproduce/published_columns.hpp"
#include "studies/reproduce/reproduction_files.hpp"

// The commands of the studies but for identify, each a folder of src/studies.
namespace twin::cli {

// Compare.

namespace {

/// The curve on which parameter updates are usually judged, where it is there.
constexpr const char* kCurveProgram = "butterfly_nurbs.nc";

/// Reads the programs named.
Expected<std::vector<gcode::ProgramText>> read_programs(const std::vector<std::string>& names,
                                                        const MachineArguments& machine,
                                                        const std::atomic<bool>& stop) {
  std::vector<gcode::ProgramText> programs;
  for (const std::string& name : names) {
    TWIN_TRY(gcode::ProgramText program, read_program(name, machine, stop));
    programs.push_back(std::move(program));
  }
  return programs;
}

Expected<studies::compare::Request> request_of(const CompareArguments& arguments,
                                               const gcode::ProgramText& program) {
  studies::compare::Request request;
  TWIN_TRY(request.machine_file, config::find_machine(arguments.machine.file));
  request.program = program;
  request.settings = arguments.machine.settings;
  request.feedrate = arguments.feedrate;
  request.running.make_machine = [hal = arguments.hal](const config::MachineFile& file) {
    return *session::make_simulated_machine(hal, file);
  };
  if (auto curve = config::find_program(kCurveProgram);
      curve && curve->filename() != program.file().filename()) {
    TWIN_TRY(gcode::ProgramText text, gcode::ProgramText::read(*curve));
    request.curve_programs.push_back(std::move(text));
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
    print_out("{}\n", to_text(grid_of_interpolators(*comparison)));
    if (!comparison->fluctuations.empty()) {
      print_out("{}\n", to_text(grid_of_fluctuations(*comparison)));
    }
  }
  return {};
}

/// Several programs: a table of the planners, without runs.
Expected<void> compare_planners(const ResultArguments& results, studies::compare::Request request,
                                const std::vector<gcode::ProgramText>& programs,
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
    print_out("{}\n", to_text(grid_of_planners(*rows)));
  }
  return {};
}

}  // namespace

Expected<void> execute(const CompareArguments& arguments, const Environment& environment) {
  if (!arguments.with.empty()) {
    return compare_with_linuxcnc(arguments, environment);
  }
  if (are_folders(arguments.programs)) {
    return compare_folders(arguments, environment);
  }
  TWIN_TRY(const auto variants, variants_of(arguments.machine.settings));
  TWIN_TRY(const auto programs,
           read_programs(arguments.programs, arguments.machine, environment.stop));
  const bool is_one = programs.size() == 1;
  if (!variants.empty()) {
    return is_one ? compare_variants(arguments, variants, programs.front(), environment)
                  : fail(ErrorCode::kUsage,
                         "several values of a setting are compared on one program, not on " +
                             std::to_string(programs.size()));
  }
  TWIN_TRY(studies::compare::Request request, request_of(arguments, programs.front()));
  const std::filesystem::path out = session::result_folder(
      arguments.results.folder,
      is_one ? request.program.file().stem().string() + "_compare" : std::string("compare"));
  TWIN_TRY(const auto workshop, pictures::Workshop::open(out));
  request.folder = workshop.folder();
  request.running.stop = &environment.stop;
  request.running.trace = arguments.results.trace;
  TWIN_CHECK(is_one ? compare_contestants(arguments.results, request, workshop)
                    : compare_planners(arguments.results, request, programs, workshop));
  if (arguments.results.verbosity == Verbosity::kNormal) {
    print_out("results in {}\n", out.string());
  }
  return {};
}

// Reproduce.

namespace {

void print(const studies::reproduce::Reproduction& reproduction) {
  print_out("{}\nA ratio is ours / published; ! marks one that is more than 30 % off.\n\n",
            reproduction.source);
  for (int table = studies::reproduce::kFirstTable; table <= studies::reproduce::kLastTable;
       ++table) {
    print_out("{}\n", to_text(grid_of_table(reproduction, table)));
  }
  print_out("{}\n{}\n\n", to_text(grid_of_counts(reproduction)), unreached(reproduction));
}

}  // namespace

Expected<void> execute(const ReproduceArguments& arguments, const Environment& environment) {
  const ResultArguments& results = arguments.results;
  studies::reproduce::Request request;
  TWIN_TRY(request.published, studies::reproduce::published());
  TWIN_TRY(request.machine_file, config::find_machine(arguments.machine.file));
  const std::filesystem::path out = session::result_folder(results.folder, "reproduce");
  TWIN_TRY(const auto workshop, pictures::Workshop::open(out));
  request.settings = arguments.machine.settings;
  request.repeats = arguments.repeats;
  request.folder = workshop.folder();
  request.running.make_machine = [](const config::MachineFile& file) {
    return *session::make_simulated_machine("mujoco", file);
  };
  request.running.stop = &environment.stop;
  request.running.trace = arguments.results.trace;
  Expected<studies::reproduce::Reproduction> reproduction;
  {
    Progress progress("machining", results.verbosity);
    request.running.progress = progress.callback();
    reproduction = studies::reproduce::reproduce(request);
  }
  if (!reproduction) {
    return tl::unexpected(reproduction.error());
  }
  {
    Progress progress("plots", results.has_plots ? results.verbosity : Verbosity::kQuiet);
    progress.show(0.0);
    TWIN_CHECK(
        write_results(*reproduction, workshop,
                      results.has_plots ? pictures::Drawing::kDrawn : pictures::Drawing::kLeftOut));
  }
  if (results.verbosity == Verbosity::kNormal) {
    print(*reproduction);
    print_out("tables and figures: {}\n", (out / "index.html").string());
  }
  return {};
}

// Circle.

namespace {

/// Runs both senses with a progress bar.
Expected<studies::circular::CircleRun> run_with_progress(const studies::circular::CircleTest& test,
                                                         Verbosity verbosity,
                                                         const std::atomic<bool>& stop) {
  using studies::circular::Sense;
  Progress progress("counter-clockwise", verbosity);
  Sense shown = Sense::kCounterClockwise;
  return studies::circular::run_circle_test(
      test,
      [&](Sense sense, double share) {
        if (sense != shown) {
          progress.rename("clockwise");
          shown = sense;
        }
        progress.show(share);
      },
      stop);
}

}  // namespace

Expected<void> execute(const CircleArguments& arguments, const Environment& environment) {
  const Verbosity verbosity = arguments.results.verbosity;
  studies::circular::CircleTest test;
  TWIN_TRY(test.machine, read_machine(arguments.machine, verbosity));
  test.hal = arguments.hal.name;
  test.make_machine = machine_of(arguments.hal);
  test.command = environment.command_line;
  test.trace = arguments.results.trace;
  test.paper = arguments.results.paper;
  test.radius = arguments.radius;
  test.feedrate = arguments.feedrate.value_or(test.feedrate);
  test.folder = session::result_folder(arguments.results.folder, "circle");
  TWIN_TRY(const auto run, run_with_progress(test, verbosity, environment.stop));
  if (verbosity == Verbosity::kNormal) {
    print_out("{}", studies::circular::to_table(run.report));
  }
  if (arguments.results.has_plots) {
    Progress progress("plots", verbosity);
    progress.show(0.0);
    TWIN_CHECK(studies::circular::draw_circle_test(test, run));
  }
  if (verbosity == Verbosity::kNormal) {
    print_out("results in {}\n", test.folder.string());
  }
  return {};
}

// Convert.

namespace {

/// The file that is written: that of --out, or one below renders.
std::filesystem::path converted_file(const ConvertArguments& arguments,
                                     const std::filesystem::path& program) {
  if (!arguments.file.empty()) {
    return arguments.file;
  }
  const auto dialect = studies::convert::make_dialect(arguments.dialect);
  const std::string name =
      fmt::format("{}.{}{}", program.stem().string(), dialect->name(), dialect->extension());
  return std::filesystem::path("renders") / program.stem() / name;
}

/// Refuses a dialect that there is not.
Expected<void> check_dialect(const std::string& name) {
  if (studies::convert::make_dialect(name) != nullptr) {
    return {};
  }
  const std::vector<std::string> names = studies::convert::dialect_names();
  return fail(ErrorCode::kUsage,
              fmt::format("--to: unknown dialect {}{} (there are {})", name,
                          config::did_you_mean(name, names), fmt::join(names, ", ")));
}

}  // namespace

Expected<void> execute(const ConvertArguments& arguments, const Environment& environment) {
  TWIN_CHECK(check_dialect(arguments.dialect));
  TWIN_TRY(const auto machine, read_machine(arguments.machine, arguments.verbosity));
  TWIN_TRY(const auto program,
           read_program(arguments.program.name, arguments.machine, environment.stop));
  const std::filesystem::path& source = program.file();
  const std::filesystem::path file = converted_file(arguments, source);
  TWIN_CHECK(session::prepare_output_file(file));
  std::error_code ignored;
  if (std::filesystem::equivalent(file, source, ignored)) {
    return fail(ErrorCode::kUsage, "--out " + file.string() + " is the program itself");
  }
  const studies::convert::Job job{program,
                                  runtime::reader_options(machine, arguments.program.feedrate),
                                  machine.path, machine.planning, machine.limits};
  TWIN_TRY(const auto checked, studies::convert::convert_and_check(job, arguments.dialect));
  TWIN_CHECK(write_whole_file(file, checked.conversion.text));
  if (arguments.verbosity == Verbosity::kNormal) {
    print_out("{}written to {}\n", studies::convert::to_table(job, arguments.dialect, checked),
              file.string());
  }
  return {};
}

}  // namespace twin::cli
