#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"

namespace twin::studies::tune {

/// A setting that is tuned, and the range that it may be in.
struct VariedKey {
  std::string key;  ///< "servo.x.kp_per_s"
  double from = 0.0;
  double to = 1.0;
  bool is_logarithmic = false;  ///< equal ratios are equal steps

  /// The value at a place of the range. @param place  0 is `from`, 1 is `to`
  double value(double place) const;
  /// The place of a value, which may lie outside of [0, 1].
  double place(double value) const;
};

/// Reads "KEY=FROM:TO" or "KEY=FROM:TO:log". @returns a kUsage error that says what is wrong with it
Expected<VariedKey> parse_varied_key(std::string_view text);

/// What is tuned.
enum class Aim {
  kContourError,  ///< least contour error
  kTime,          ///< least machining time within a given contour error
};

/// The keys that are tuned unless others are named: position gain, derivative gain, velocity and
/// acceleration feedforward of both axes; for kTime jerk and tolerances of the planner as well.
/// Ranges lie around the values of the machine.
std::vector<VariedKey> usual_keys(const config::MachineFile& machine, Aim aim);

/// Value of a numeric setting of a machine. @returns a kUsage error where there is none of this name
Expected<double> number_of(const config::MachineFile& machine, std::string_view key);

}  // namespace twin::studies::tune
