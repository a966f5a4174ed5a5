#include <fmt/format.h>

#include <system_error>

#include "cli/circle_test.hpp"
#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "cli/progress.hpp"
#include "core/atomic_file.hpp"
#include "core/units.hpp"
#include "pictures/plot/circular_figure.hpp"
#include "runtime/run.hpp"
#include "session/results.hpp"
#include "studies/circular/circle_program.hpp"
#include "studies/circular/circular_report.hpp"
#include "studies/circular/measured_turn.hpp"
#include "studies/circular/servo_prediction.hpp"

namespace twin::cli {
namespace {

namespace fs = std::filesystem;

/// One sense of the test.
struct SenseRun {
  studies::circular::MeasuredTurn turn;
  std::string interpolator;
};
/// Counter-clockwise first.
using BothRuns = std::array<SenseRun, 2>;

/// Makes the folder; no result of an earlier test may pass for one of this.
Expected<void> prepare_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return file_error(folder, "create", error.value());
  }
  for (const char* name : {"circle.json", "plots/circular_test.png", "plots/circular_test.svg"}) {
    fs::remove(folder / name, error);
  }
  return {};
}

/// Runs one sense with a machine of its own and reads what it measured.
Expected<SenseRun> run_sense(const CircleTest& test, studies::circular::Sense sense,
                             const Options& options, const std::atomic<bool>& stop) {
  const std::string name(studies::circular::short_name(sense));
  const auto hal = open_machine(options, test.machine, "circle");
  if (!hal) {
    return tl::unexpected(hal.error());
  }
  runtime::RunRequest request;
  request.program = test.folder / fmt::format("circle_{}.nc", name);
  request.machine = test.machine;
  request.hal = hal->get();
  request.is_wall_clock = (*hal)->info().keeps_own_time;
  request.directory = test.folder / name;
  request.stop = &stop;
  if (auto written = write_whole_file(request.program.file, studies::circular::circle_program(
                                                                test.radius, test.feedrate, sense));
      !written) {
    return tl::unexpected(written.error());
  }
  Progress progress(
      sense == studies::circular::Sense::kClockwise ? "clockwise" : "counter-clockwise",
      options.quiet);
  request.progress = progress.callback();
  const auto result = runtime::run_program(request);
  if (!result) {
    return tl::unexpected(result.error());
  }
  if (auto written = session::write_summary(request.directory, *result); !written) {
    return tl::unexpected(written.error());
  }
  if (result->failure) {
    return tl::unexpected(*result->failure);
  }
  session::remove_stale_results(request.directory);
  auto turn = studies::circular::read_measured_turn(request.directory / "trace.csv");
  if (!turn) {
    return tl::unexpected(turn.error());
  }
  return SenseRun{std::move(*turn), result->summary.interpolator};
}

studies::circular::Measured figures_of(const studies::circular::BothPaths& paths,
                                       const CircleTest& test,
                                       const std::array<double, 2>& reached) {
  studies::circular::Measured figures;
  figures.deviations = studies::circular::evaluate(paths, test.radius);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    figures.spikes[i] = studies::circular::find_reversal_spikes(
        paths[i], studies::circular::kSenses[i],
        studies::circular::spike_reach(reached[i] / test.radius));
  }
  return figures;
}

studies::circular::Report make_report(const CircleTest& test, const BothRuns& runs,
                                      const Options& options) {
  studies::circular::Report report;
  report.machine = test.machine.name;
  report.hal = options.hal;
  report.interpolator = runs[0].interpolator;
  report.period = test.machine.period;
  report.radius = test.radius;
  report.feedrate = test.feedrate;
  report.reached = {runs[0].turn.feedrate, runs[1].turn.feedrate};
  report.table = figures_of({runs[0].turn.table, runs[1].turn.table}, test, report.reached);
  report.encoder = figures_of({runs[0].turn.encoder, runs[1].turn.encoder}, test, report.reached);
  if (options.hal == "ideal") {
    report.no_prediction = "the ideal machine has no servo";
    return report;
  }
  const double reached = 0.5 * (report.reached[0] + report.reached[1]);
  const auto predicted =
      studies::circular::predicted_radial_deviation(test.machine.servo, test.radius, reached);
  if (predicted) {
    report.predicted = *predicted;
  } else {
    report.no_prediction = predicted.error().message;
  }
  return report;
}

Expected<void> write_picture(const CircleTest& test, const BothRuns& runs, const std::string& hal,
                             bool quiet) {
  Progress progress("plots", quiet);
  progress.show(0.0);
  pictures::CircularFigureInput input;
  input.directory = test.folder;
  input.title = fmt::format("Circular test, radius {:g} mm, {:g} mm/min", test.radius,
                            units::mm_per_min_from_mm_per_s(test.feedrate));
  input.subtitle = fmt::format("{} ({}), position of the table", test.machine.name, hal);
  input.radius = test.radius;
  input.path = {runs[0].turn.table, runs[1].turn.table};
  auto pictures = pictures::write_circular_figure(input);
  if (!pictures) {
    return tl::unexpected(pictures.error());
  }
  return {};
}

Expected<void> circle_command(const Options& options, const std::atomic<bool>& stop) {
  const auto test = make_circle_test(options);
  if (!test) {
    return tl::unexpected(test.error());
  }
  if (auto prepared = prepare_folder(test->folder); !prepared) {
    return prepared;
  }
  BothRuns runs;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    auto run = run_sense(*test, studies::circular::kSenses[i], options, stop);
    if (!run) {
      return tl::unexpected(run.error());
    }
    runs[i] = std::move(*run);
  }
  const studies::circular::Report report = make_report(*test, runs, options);
  if (auto written =
          write_whole_file(test->folder / "circle.json", studies::circular::to_json(report));
      !written) {
    return written;
  }
  if (!options.quiet) {
    fmt::print("{}", studies::circular::to_table(report));
  }
  if (!options.no_plots) {
    if (auto drawn = write_picture(*test, runs, options.hal, options.quiet); !drawn) {
      return drawn;
    }
  }
  if (!options.quiet) {
    fmt::print("results in {}\n", test->folder.string());
  }
  return {};
}

}  // namespace

Command add_circle(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "circle", "Circular test after ISO 230-4: both senses, deviations, reversal spikes");
  app->add_option("--radius-mm", options.radius_mm, "Radius of the circle about X0 Y0")
      ->type_name("R")
      ->capture_default_str();
  add_feedrate_option(*app, options, "Feedrate [3000]");
  add_machine_options(*app, options);
  add_interpolator_option(*app, options);
  add_hal_option(*app, options, true);
  add_rig_options(*app, options, true);
  add_result_options(*app, options, "circle");
  return {app, [&options, &stop = context.stop] { return circle_command(options, stop); }};
}

}  // namespace twin::cli
