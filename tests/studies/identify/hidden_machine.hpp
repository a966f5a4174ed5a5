#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "config/binding.hpp"
#include "config/machine_file.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "runtime/run.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::identify {

/// The machine that fits begin at: the built-in table, whose friction is far above the floor of
/// its encoders and hum.
inline config::MachineFile known_machine() {
  auto read = config::read_machine_file(TWIN_SOURCE_DIR "/mjcf/xy_table.toml");
  EXPECT_TRUE(read) << (read ? "" : to_string(read.error()));
  config::MachineFile machine = read.value_or(config::MachineFile());
  const hal::mujoco::TableParams built_in;
  machine.table.axis = built_in.axis;
  machine.table.physics_step = built_in.physics_step;
  machine.path.planner = Planner::kPaper;
  machine.servo[hal::kX] = {.kp = 150.0, .kd = 0.0, .kf = 1.003, .ka = 0.0023, .trim_V = 0.0};
  machine.servo[hal::kY] = {.kp = 150.0, .kd = 0.0, .kf = 1.008, .ka = 0.0024, .trim_V = 0.0};
  return machine;
}

/// A machine that is not known: everything a trace shows is changed, most of it by 20 to 50 %.
/// Counts are of 1 um.
inline config::MachineFile hidden_machine(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&random](double low, double high) {
    return low +
           (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  const auto changed = [&](double value) {
    return value * (between(0.0, 1.0) < 0.5 ? between(0.5, 0.8) : between(1.2, 1.5));
  };
  config::MachineFile machine = known_machine();
  for (hal::mujoco::AxisParams& axis : machine.table.axis) {
    axis.friction.coulomb = changed(axis.friction.coulomb);
    axis.friction.static_ratio = between(1.3, 2.0);
    axis.friction.stribeck_velocity = changed(axis.friction.stribeck_velocity);
    axis.friction.bristle_stiffness = changed(axis.friction.bristle_stiffness);
    axis.friction.bristle_damping = changed(axis.friction.bristle_damping);
    axis.friction.viscous = changed(axis.friction.viscous);
    axis.drive.velocity_gain_Hz *= between(1.2, 1.5);  // softer ones oscillate
    axis.drive.integral_time *= between(1.2, 1.5);
    axis.drive.output_delay = changed(axis.drive.output_delay);
    axis.motor.current_lag = changed(axis.motor.current_lag);
    axis.drive.vref_offset = between(-6e-3, 6e-3);
    axis.drive.hum_amplitude = changed(axis.drive.hum_amplitude);
    axis.drive.hum_frequency_Hz = 50.0;
    axis.drive.hum_phase = between(-3.0, 3.0);
    axis.encoder.mm_per_count = 1e-3;
  }
  for (motion::Gains& gains : machine.servo) {
    gains.kp *= between(0.5, 0.8);
    gains.kf = between(0.99, 1.01);
    gains.ka = changed(gains.ka);
  }
  return machine;
}

/// Runs a program on a machine; the trace is left in the folder. @returns contour error RMS [mm]
inline double run_on(const config::MachineFile& machine, const std::string& program,
                     const std::filesystem::path& folder) {
  hal::mujoco::MujocoMachine table(machine.table);
  runtime::RunRequest request;
  request.program = test::text_of(std::string(TWIN_SOURCE_DIR "/nc_programs/") + program);
  request.machine = machine;
  request.hal = &table;
  request.directory = folder;
  const auto result = runtime::run_program(request);
  EXPECT_TRUE(result) << (result ? "" : to_string(result.error()));
  if (!result || !result->summary.run) {
    ADD_FAILURE() << "no run";
    return 0.0;
  }
  return result->summary.run->contour_error.rms;
}

/// Value of a key in a machine, in the key's unit.
inline double value_of(const config::MachineFile& machine, const std::string& key) {
  config::MachineFile copy = machine;
  for (const config::Binding& binding : config::bindings(copy)) {
    if (binding.path() == key) {
      return *std::get<double*>(binding.target) * binding.per_base;
    }
  }
  ADD_FAILURE() << "no key " << key;
  return 0.0;
}

}  // namespace twin::studies::identify
