#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "session/results.hpp"
#include "studies/circular/circle_test.hpp"

namespace twin::cli {
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
  test.radius = arguments.radius;
  test.feedrate = arguments.feedrate.value_or(test.feedrate);
  test.folder = session::result_folder(arguments.results.folder, "circle");
  TWIN_TRY(const auto run, run_with_progress(test, verbosity, environment.stop));
  if (verbosity == Verbosity::kNormal) {
    fmt::print("{}", studies::circular::to_table(run.report));
  }
  if (arguments.results.has_plots) {
    Progress progress("plots", verbosity);
    progress.show(0.0);
    TWIN_CHECK(studies::circular::draw_circle_test(test, run));
  }
  if (verbosity == Verbosity::kNormal) {
    fmt::print("results in {}\n", test.folder.string());
  }
  return {};
}

}  // namespace twin::cli
