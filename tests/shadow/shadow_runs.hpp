#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "runtime/run.hpp"
#include "shadow/shadow.hpp"
#include "twin/trace.hpp"

/// Runs of the simulated table whose phases nobody knows, as a shadow sees them.
namespace twin::shadow {

template <class T>
T checked(Expected<T> value) {
  if (!value) {
    throw std::runtime_error(to_string(value.error()));
  }
  return *std::move(value);
}

inline config::MachineFile table_machine(bool gives = false) {
  config::MachineFile machine =
      checked(config::read_machine_file(TWIN_SOURCE_DIR "/mjcf/xy_table.toml"));
  machine.shadow.reads_counts = std::getenv("TWIN_SHADOW_COUNTS") != nullptr;
  if (gives) {
    machine.table.model = TWIN_SOURCE_DIR "/mjcf/xy_table_compliant.xml";
  }
  return machine;
}

/// Resolution of a scale on the table [mm].
inline constexpr double kScaleStep = 1e-4;

/// A run that is to be made.
struct RunPlan {
  std::string program;
  double feedrate_mm_per_min = 3000.0;
  unsigned seed = 1;                   ///< of the phases
  std::vector<std::string> changes{};  ///< as --change takes them
};

inline Track record(config::MachineFile machine, const RunPlan& plan) {
  std::mt19937 random(plan.seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (hal::mujoco::AxisParams& axis : machine.table.axis) {
    axis.drive.hum_phase = 2.0 * std::numbers::pi * share(random);
    axis.encoder.phase = share(random);
  }
  for (const std::string& text : plan.changes) {
    machine.table.changes.push_back(checked(hal::mujoco::parse_change(text)));
  }
  hal::mujoco::MujocoMachine table(machine.table);
  MemoryTrace trace;
  runtime::RunRequest request;
  request.program =
      checked(gcode::ProgramText::read(TWIN_SOURCE_DIR "/nc_programs/" + plan.program + ".nc"));
  request.machine = machine;
  request.hal = &table;
  request.feedrate = units::mm_per_s_from_mm_per_min(plan.feedrate_mm_per_min);
  request.sinks.push_back(&trace);
  const runtime::RunResult result = checked(runtime::run_program(request));
  Track track;
  track.name = plan.program;
  track.recorded[hal::kX].has_scale = machine.shadow.has_scale;
  track.recorded[hal::kY].has_scale = machine.shadow.has_scale;
  const auto time = trace["t_s"];
  const auto line = trace["line"];
  for (std::size_t k = 0; k < trace.size(); ++k) {
    ShadowSample sample{.time = time[k], .line = static_cast<std::int64_t>(line[k]), .axis = {}};
    sample.axis[hal::kX] = {.measured = trace["x_enc_mm"][k], .volts = trace["x_drive_V"][k]};
    sample.axis[hal::kY] = {.measured = trace["y_enc_mm"][k], .volts = trace["y_drive_V"][k]};
    sample.axis[hal::kX].scale = kScaleStep * std::round(trace["x_table_mm"][k] / kScaleStep);
    sample.axis[hal::kY].scale = kScaleStep * std::round(trace["y_table_mm"][k] / kScaleStep);
    track.samples.push_back(sample);
  }
  return track;
}

}  // namespace twin::shadow
