#pragma once

#include <array>
#include <optional>

#include "twin/export.hpp"
#include "twin/machine.hpp"
#include "twin/set_point.hpp"

namespace twin {

/// The position loops of X and Y, for a controller of one's own in place of the PD loops with
/// feedforward that the settings describe. Give its address to run() in RunOptions::servo.
class TWIN_EXPORT Servo {
 public:
  Servo() = default;
  Servo(const Servo&) = delete;
  Servo& operator=(const Servo&) = delete;
  virtual ~Servo() = default;

  /// Computes the drive commands of a period. It is called in the motion's thread, once in each
  /// period in which the machine is on, also while it stands still before the first set point.
  ///
  /// @param point     set point of the period
  /// @param measured  position of X and Y by the encoders [mm]
  /// @returns V-REF of both axes [V], which is cut to +-10 V. Nothing, or a value that is no finite
  ///          number, ends the run in the same period with 0 V and servo off.
  virtual std::optional<std::array<double, kServoAxes>> volts(
      const SetPoint& point, const std::array<double, kServoAxes>& measured) noexcept = 0;
};

}  // namespace twin
