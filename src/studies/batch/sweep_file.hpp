#pragma once

#include <filesystem>
#include <string_view>

#include "core/error.hpp"
#include "studies/batch/sweep.hpp"

namespace twin::studies::batch {

/// Reads a sweep (TOML):
///
///     program = "dolphin.nc"              # or a list of programs
///     machine = "xy_table.toml"
///     feedrate_mm_per_min = [1500, 3000]  # a number, a list, or left out
///     hal = "mujoco"
///     trace = false
///
///     [set]                               # the same for all
///     "servo.x.kd" = 0.001
///
///     [grid]                              # every combination
///     "servo.x.kp_per_s" = [200, 250, 300]
///     "servo.y.kp_per_s" = { from = 60, to = 120, count = 5 }
///
///     [latin_hypercube]
///     count = 100
///     seed = 1
///     "servo.x.kf" = { from = 0.9, to = 1.1 }
///
///     [monte_carlo]
///     count = 200
///     seed = 1
///     "table.x.coulomb_friction_N" = { mean = 1.8, sigma = 0.2 }
///     identified = "identify.json"        # what twin identify has found, with its deviations
///
/// @returns the sweep, or an error with file, line and column
Expected<Sweep> read_sweep(const std::filesystem::path& file);

/// The same from a text. @param file  for messages
Expected<Sweep> parse_sweep(std::string_view text, const std::filesystem::path& file);

}  // namespace twin::studies::batch
