// Prints the table of docs/compensation.md: contour errors of the table without and with a
// correction, for programs and feedrates that the command line names.
//
//   compensation_table [PROGRAM ...] [F ...]     numbers are feedrates in mm/min
//
// Every figure is of the model that twin identify fits with, which moves as MuJoCo's table does.

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "runtime/correction_file.hpp"
#include "studies/circular/circle_program.hpp"
#include "studies/circular/reversal_spikes.hpp"
#include "studies/compensate/learning.hpp"
#include "studies/compensate/model_run.hpp"

namespace twin::studies::compensate {
namespace {

constexpr std::size_t kEvaluated = 20;  // runs of the default table, with phases of their own
constexpr double kOtherPhases = 0.37;   // shift of them against those that were learnt with
constexpr int kLearningRuns = 3;

template <class T>
T checked(Expected<T> value) {
  if (!value) {
    fmt::print(stderr, "{}\n", to_string(value.error()));
    std::exit(1);
  }
  return *std::move(value);
}

config::MachineFile default_machine() {
  return checked(config::read_machine_file(TWIN_SOURCE_DIR "/mjcf/xy_table.toml"));
}

config::MachineFile clean_machine() {
  config::MachineFile machine = default_machine();
  for (hal::mujoco::AxisParams& axis : machine.table.axis) {
    axis.drive.hum_amplitude = 0.0;
    axis.encoder.mm_per_count = 0.001;
  }
  return machine;
}

/// A table with 20 % more friction and inertia, and a loop that is 20 % slower.
config::MachineFile off_by_20_percent(config::MachineFile machine) {
  for (hal::mujoco::AxisParams& axis : machine.table.axis) {
    axis.moving_mass *= 1.2;
    axis.friction.coulomb *= 1.2;
    axis.friction.viscous *= 1.2;
    axis.drive.velocity_gain_Hz *= 0.8;
    axis.drive.integral_time *= 1.2;
  }
  return machine;
}

/// Error without and with a correction.
struct Pair {
  results::ErrorStats before;
  results::ErrorStats after;
};

std::string cells(const Pair& pair) {
  const auto one = [](double before, double after) {
    return fmt::format("{:.1f} -> {:.1f} ({:.0f} %)", units::um_from_mm(before),
                       units::um_from_mm(after), 100.0 * (1.0 - after / before));
  };
  return one(pair.before.max, pair.after.max) + " | " + one(pair.before.rms, pair.after.rms);
}

struct Setting {
  gcode::ProgramText program;
  double feedrate;
};

/// The path of a run without and the one with reserve.
struct Paths {
  ContourPath plain;
  ContourPath reserved;
};

Paths paths_of(const Setting& setting, const config::MachineFile& machine) {
  return {checked(ContourPath::plan(setting.program, machine, setting.feedrate)),
          checked(ContourPath::plan(setting.program, runtime::planned_with_reserve(machine),
                                    setting.feedrate))};
}

results::ErrorStats one_run(const config::MachineFile& machine, const ContourPath& path,
                            std::span<const Vec2> offsets) {
  return stats_of(path.errors(run_model(machine, path.points(), offsets, Phases{}).table));
}

results::ErrorStats mean_of_runs(const config::MachineFile& machine, const ContourPath& path,
                                 std::span<const Vec2> offsets) {
  return stats_of(
      path.errors(mean_run(machine, path.points(), offsets, kEvaluated, kOtherPhases).table));
}

std::string clean_cells(const Setting& setting) {
  const config::MachineFile machine = clean_machine();
  const Paths paths = paths_of(setting, machine);
  const MadeCorrection made = checked(make_correction(setting.program, machine, setting.feedrate));
  const double before = paths.plain.time(machine.period);
  return cells({one_run(machine, paths.plain, {}),
                one_run(machine, paths.reserved, made.correction.offsets)}) +
         fmt::format(" | {:.2f} -> {:.2f}", before, paths.reserved.time(machine.period));
}

std::string default_cells(const Setting& setting) {
  const config::MachineFile machine = default_machine();
  const Paths paths = paths_of(setting, machine);
  const MadeCorrection made = checked(make_correction(setting.program, machine, setting.feedrate));
  return cells({mean_of_runs(machine, paths.plain, {}),
                mean_of_runs(machine, paths.reserved, made.correction.offsets)});
}

/// The first run, and the one after three learning runs, on a table that differs from the model.
std::string off_cells(const Setting& setting) {
  const config::MachineFile machine = clean_machine();
  const config::MachineFile truth = off_by_20_percent(machine);
  const Paths paths = paths_of(setting, machine);
  const results::ErrorStats before = one_run(truth, paths.plain, {});
  MadeCorrection made = checked(make_correction(setting.program, machine, setting.feedrate));
  const results::ErrorStats first = one_run(truth, paths.reserved, made.correction.offsets);
  Learnt learnt;
  for (int i = 0; i < kLearningRuns; ++i) {
    const Phases phases = even_phases(static_cast<std::size_t>(i), kLearningRuns, 0.21);
    const ModelRun run = run_model(truth, paths.reserved.points(), made.correction.offsets, phases);
    const auto added =
        add_run(machine, paths.reserved, run.encoder, made.correction.offsets, learnt);
    if (!added) {
      fmt::print(stderr, "{}\n", to_string(added.error()));
      std::exit(1);
    }
    CompensateOptions options;
    options.mismatch = learnt.mismatch;
    made = checked(make_correction(setting.program, machine, setting.feedrate, options));
  }
  return cells({before, first}) + " | " +
         cells({before, one_run(truth, paths.reserved, made.correction.offsets)});
}

/// Largest spike of each axis in the circular test without hum, counts of 1 um.
void print_spikes(double radius, double feedrate) {
  const config::MachineFile machine = clean_machine();
  for (const circular::Sense sense : circular::kSenses) {
    const Setting setting{
        gcode::ProgramText::from_text(circular::circle_program(radius, feedrate, sense), "c.nc"),
        feedrate};
    const Paths paths = paths_of(setting, machine);
    const MadeCorrection made = checked(make_correction(setting.program, machine, std::nullopt));
    const auto heights = [&](const ContourPath& path, std::span<const Vec2> offsets) {
      const ModelRun run = run_model(machine, path.points(), offsets, Phases{});
      std::vector<Vec2> turn;
      for (std::size_t k = 0; k < path.points().size(); ++k) {
        if (path.points()[k].line == circular::kMeasuredLine) {
          turn.push_back(run.table[k]);
        }
      }
      const auto spikes =
          circular::find_reversal_spikes(turn, sense, circular::spike_reach(feedrate / radius));
      std::array<double, 2> height{};
      for (std::size_t i = 0; i < 4; ++i) {
        height[i % 2] = std::max(height[i % 2], std::abs(spikes.quadrant[i].height));
      }
      return height;
    };
    const auto before = heights(paths.plain, {});
    const auto after = heights(paths.reserved, made.correction.offsets);
    fmt::print("| {} | {:g} |", circular::short_name(sense), feedrate * 60.0);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      fmt::print(" {:.2f} -> {:.2f} ({:.0f} %) |", units::um_from_mm(before[axis]),
                 units::um_from_mm(after[axis]), 100.0 * (1.0 - after[axis] / before[axis]));
    }
    fmt::print("\n");
  }
}

void print_tables(const std::vector<std::string>& programs, const std::vector<double>& feedrates) {
  fmt::print(
      "| program | F | no hum, 1 um: max, um | RMS, um | time, s | default, mean of 20: max | RMS "
      "| 20 % off: max | RMS | after 3 runs: max | RMS |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const std::string& program : programs) {
    const Setting any{
        checked(gcode::ProgramText::read(TWIN_SOURCE_DIR "/nc_programs/" + program + ".nc")), 0.0};
    for (const double feedrate : feedrates) {
      const Setting setting{any.program, feedrate / 60.0};
      fmt::print("| {} | {:g} | {} | {} | {} |\n", program, feedrate, clean_cells(setting),
                 default_cells(setting), off_cells(setting));
      std::fflush(stdout);
    }
  }
  fmt::print(
      "\n| circular test | F | spike of X, um | spike of Y, um |\n| --- | --- | --- | --- |\n");
  for (const double feedrate : feedrates) {
    print_spikes(20.0, feedrate / 60.0);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace twin::studies::compensate

int main(int argc, char** argv) {
  std::vector<std::string> programs;
  std::vector<double> feedrates;
  for (int i = 1; i < argc; ++i) {
    const double feedrate = std::atof(argv[i]);
    if (feedrate > 0.0) {
      feedrates.push_back(feedrate);
    } else {
      programs.emplace_back(argv[i]);
    }
  }
  if (programs.empty()) {
    programs = {"dolphin", "oxalis", "square", "star", "butterfly", "circle"};
  }
  if (feedrates.empty()) {
    feedrates = {1000.0, 3000.0, 6000.0};
  }
  twin::studies::compensate::print_tables(programs, feedrates);
  return 0;
}
