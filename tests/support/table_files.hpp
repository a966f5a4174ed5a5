#pragma once

#include <string>

#include "hal/mujoco/table_params.hpp"

namespace twin::test {

/// A file of the repository's mjcf folder.
inline std::string mjcf_file(const std::string& name) {
  return std::string(TWIN_SOURCE_DIR) + "/mjcf/" + name;
}

/// The table as the machine file has it.
inline hal::mujoco::TableParams default_table() {
  hal::mujoco::TableParams params;
  params.model = mjcf_file("xy_table.xml");
  return params;
}

/// The table without friction, disturbance, delay, lag and visible quantisation.
inline hal::mujoco::TableParams faultless_table() {
  hal::mujoco::TableParams params = default_table();
  for (hal::mujoco::AxisParams& axis : params.axis) {
    axis.friction.coulomb = 0.0;
    axis.friction.viscous = 0.0;
    axis.drive.hum_amplitude = 0.0;
    axis.drive.output_delay = 0.0;
    axis.drive.velocity_gain_Hz = 500.0;
    axis.drive.integral_time = 20e-3;
    axis.motor.current_lag = 0.0;
    axis.encoder.mm_per_count = 1e-7;
    axis.dac_bits = 40;
  }
  return params;
}

}  // namespace twin::test
