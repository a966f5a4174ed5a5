#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "feedrate/profile/ramps.hpp"

namespace twin::test {

/// A change of feedrate by D with a(t) = min(J t, A, J (tau - t)), integrated numerically.
///
/// tau comes from bisecting the area under a(t): nothing here uses the closed forms under test.
class SCurve {
 public:
  SCurve(double delta, const feedrate::RampLimits& limits) : limits_(limits) {
    double low = 0.0;
    double high = 1.0;
    while (area(high) < delta) {
      high *= 2.0;
    }
    for (int i = 0; i < 200; ++i) {
      tau_ = 0.5 * (low + high);
      (area(tau_) < delta ? low : high) = tau_;
    }
  }

  double duration() const { return tau_; }

  /// Distance from v1 until the feedrate is v (or the end), by the trapezoidal rule [mm].
  double distance_until(double v1, double v) const {
    constexpr int kSteps = 40000;
    const double dt = tau_ / kSteps;
    double speed = v1;
    double distance = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double gain =
          0.5 * dt * (acceleration(i * dt, tau_) + acceleration((i + 1) * dt, tau_));
      if (speed + gain > v) {
        return distance + 0.5 * (speed + v) * dt * (v - speed) / gain;
      }
      distance += dt * (speed + 0.5 * gain);
      speed += gain;
    }
    return distance;
  }

 private:
  double acceleration(double t, double tau) const {
    return std::min({limits_.jerk * t, limits_.acceleration, limits_.jerk * (tau - t)});
  }

  double area(double tau) const {  // exact on each straight part
    const double turn = std::min(0.5 * tau, limits_.acceleration / limits_.jerk);
    return limits_.jerk * turn * (tau - turn);
  }

  feedrate::RampLimits limits_;
  double tau_ = 0.0;
};

inline constexpr std::array<AccelerationProfile, 3> kProfiles{
    AccelerationProfile::kTrapezoidal, AccelerationProfile::kSCurve, AccelerationProfile::kFir};

/// Number between two, evenly spread in its logarithm.
inline double log_uniform(std::mt19937& random, double low, double high) {
  return low * std::pow(high / low, std::uniform_real_distribution<double>()(random));
}

inline feedrate::RampLimits random_limits(std::mt19937& random) {
  return {log_uniform(random, 200.0, 2e4), log_uniform(random, 5e3, 2e6)};
}

}  // namespace twin::test
