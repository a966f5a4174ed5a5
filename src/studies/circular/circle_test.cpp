#include "studies/circular/circle_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <system_error>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/units.hpp"
#include "pictures/plot/circular_figure.hpp"
#include "session/session.hpp"
#include "studies/circular/deviations.hpp"
#include "studies/circular/reversal_spikes.hpp"

namespace twin::studies::circular {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastRadius = 0.1;    // [mm]; smaller ones are made of a few set points
constexpr double kLongestTurn = 600.0;  // [s]; the paths are held in memory

Expected<void> check_radius(double radius, const Limits& limits) {
  if (!(radius >= kLeastRadius) || !std::isfinite(radius)) {
    return fail(ErrorCode::kUsage,
                fmt::format("--radius-mm {:g} is not at least {:g}", radius, kLeastRadius));
  }
  const double room = std::min({limits.travel_max.x(), limits.travel_max.y(),
                                -limits.travel_min.x(), -limits.travel_min.y()});
  if (radius > room) {
    return fail(ErrorCode::kUsage,
                fmt::format("--radius-mm {:g} leaves the travel: about X0 Y0 there is room for "
                            "{:g} mm (limits.travel_min_mm, limits.travel_max_mm)",
                            radius, room));
  }
  return {};
}

Expected<void> check_feedrate(double feedrate, double radius, const Limits& limits) {
  const double wanted = units::mm_per_min_from_mm_per_s(feedrate);
  if (!(feedrate <= limits.feedrate)) {
    return fail(ErrorCode::kUsage,
                fmt::format("--feedrate-mm-per-min {:g} is above the machine's largest, "
                            "limits.feedrate_mm_per_min = {:g}",
                            wanted, units::mm_per_min_from_mm_per_s(limits.feedrate)));
  }
  const double turn = 2.0 * std::numbers::pi * radius / feedrate;
  if (turn > kLongestTurn) {
    return fail(ErrorCode::kUsage,
                fmt::format("one turn of {:g} mm radius at {:g} mm/min takes {:.0f} s, more than "
                            "{:g} s",
                            radius, wanted, turn, kLongestTurn));
  }
  return {};
}

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

/// What one sense has shown.
struct SenseRun {
  MeasuredTurn turn;
  std::string interpolator;
};

/// Runs one sense with a machine of its own and reads what it measured.
Expected<SenseRun> run_sense(const CircleTest& test, Sense sense,
                             const std::function<void(Sense, double)>& progress,
                             const std::atomic<bool>& stop) {
  const std::string name(short_name(sense));
  TWIN_TRY(const auto hal, test.make_machine(test.machine, "circle"));
  const fs::path program = test.folder / fmt::format("circle_{}.nc", name);
  const std::string text = circle_program(test.radius, test.feedrate, sense);
  TWIN_CHECK(write_whole_file(program, text));
  session::Request request;
  request.program = gcode::ProgramText::from_text(text, program);
  request.machine = test.machine;
  request.hal = hal.get();
  request.folder = test.folder / name;
  request.command = test.command;
  request.trace = test.trace;
  TWIN_TRY(session::Session session, session::Session::open(std::move(request)));
  session::Attendance attendance;
  attendance.stop = &stop;
  if (progress) {
    attendance.progress = [&](double share) { progress(sense, share); };
  }
  TWIN_TRY(const runtime::RunResult result, session.run(attendance));
  if (result.failure) {
    return tl::unexpected(*result.failure);
  }
  TWIN_TRY(MeasuredTurn turn, read_measured_turn(session.trace_file()));
  return SenseRun{std::move(turn), result.summary.interpolator};
}

Measured figures_of(const BothPaths& paths, const CircleTest& test,
                    const std::array<double, 2>& reached) {
  Measured figures;
  figures.deviations = evaluate(paths, test.radius);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    figures.spikes[i] =
        find_reversal_spikes(paths[i], kSenses[i], spike_reach(reached[i] / test.radius));
  }
  return figures;
}

Report make_report(const CircleTest& test, const std::array<MeasuredTurn, 2>& turns,
                   const std::string& interpolator) {
  Report report;
  report.machine = test.machine.name;
  report.hal = test.hal;
  report.interpolator = interpolator;
  report.period = test.machine.period;
  report.radius = test.radius;
  report.feedrate = test.feedrate;
  report.reached = {turns[0].feedrate, turns[1].feedrate};
  report.table = figures_of({turns[0].table, turns[1].table}, test, report.reached);
  report.encoder = figures_of({turns[0].encoder, turns[1].encoder}, test, report.reached);
  if (test.hal == "ideal") {
    report.no_prediction = "the ideal machine has no servo";
    return report;
  }
  const double reached = 0.5 * (report.reached[0] + report.reached[1]);
  const auto predicted = predicted_radial_deviation(test.machine.servo, test.radius, reached);
  if (predicted) {
    report.predicted = *predicted;
  } else {
    report.no_prediction = predicted.error().message;
  }
  return report;
}

}  // namespace

Expected<CircleRun> run_circle_test(const CircleTest& test,
                                    const std::function<void(Sense, double)>& progress,
                                    const std::atomic<bool>& stop) {
  TWIN_CHECK(check_radius(test.radius, test.machine.limits));
  TWIN_CHECK(check_feedrate(test.feedrate, test.radius, test.machine.limits));
  TWIN_CHECK(prepare_folder(test.folder));
  CircleRun run;
  std::string interpolator;
  for (std::size_t i = 0; i < kSenses.size(); ++i) {
    TWIN_TRY(SenseRun sense, run_sense(test, kSenses[i], progress, stop));
    run.turns[i] = std::move(sense.turn);
    if (i == 0) {
      interpolator = sense.interpolator;
    }
  }
  run.report = make_report(test, run.turns, interpolator);
  TWIN_CHECK(write_whole_file(test.folder / "circle.json", to_json(run.report)));
  return run;
}

Expected<void> draw_circle_test(const CircleTest& test, const CircleRun& run) {
  pictures::CircularFigureInput input;
  input.directory = test.folder;
  input.title = fmt::format("Circular test, radius {:g} mm, {:g} mm/min", test.radius,
                            units::mm_per_min_from_mm_per_s(test.feedrate));
  input.subtitle = fmt::format("{} ({}), position of the table", test.machine.name, test.hal);
  input.paper = test.paper;
  input.radius = test.radius;
  input.path = {run.turns[0].table, run.turns[1].table};
  TWIN_CHECK(pictures::write_circular_figure(input));
  return {};
}

}  // namespace twin::studies::circular
