#pragma once

#include <cmath>

namespace twin::studies::identify {

/// The values a sin(w k h + phi), k = 0, 1, 2 ..., one after the other.
///
/// A sine costs more than the rest of a physics step. So the angle is turned by w h from value to
/// value, and begun anew every kAnew values: the error stays below 1e-13 a.
class SineSteps {
 public:
  /// @param amplitude  a  @param step_angle  w h [rad]  @param phase  phi [rad]
  SineSteps(double amplitude, double step_angle, double phase)
      : amplitude_(amplitude),
        step_angle_(step_angle),
        phase_(phase),
        turn_sin_(std::sin(step_angle)),
        turn_cos_(std::cos(step_angle)) {}

  bool is_zero() const noexcept { return amplitude_ == 0.0; }

  double next() noexcept {
    if (count_ % kAnew == 0) {
      const double angle = step_angle_ * static_cast<double>(count_) + phase_;
      sin_ = std::sin(angle);
      cos_ = std::cos(angle);
    }
    ++count_;
    const double value = amplitude_ * sin_;
    const double turned = sin_ * turn_cos_ + cos_ * turn_sin_;
    cos_ = cos_ * turn_cos_ - sin_ * turn_sin_;
    sin_ = turned;
    return value;
  }

 private:
  static constexpr long kAnew = 256;
  double amplitude_;
  double step_angle_;
  double phase_;
  double turn_sin_;
  double turn_cos_;
  double sin_ = 0.0;
  double cos_ = 1.0;
  long count_ = 0;
};

}  // namespace twin::studies::identify
