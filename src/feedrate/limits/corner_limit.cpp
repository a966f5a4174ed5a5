#include "feedrate/limits/corner_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twin::feedrate {
namespace {

constexpr double kRipple = 0.1;  // share of J_max that a hidden corner may seem to be

}  // namespace

double corner_model_feedrate(double turn, double corner_error,
                             const PlanningModel& model) noexcept {
  const double c = std::sin(0.5 * turn);  // cos(theta / 2)
  return c > 0.0 ? model.kp / (1.0 - model.kf) * corner_error / c
                 : std::numeric_limits<double>::infinity();
}

double corner_acceleration_feedrate(double turn, double curvature, double acceleration,
                                    double period) noexcept {
  const double c = 2.0 * std::sin(0.5 * turn);
  const double k = curvature * period;
  const double at = acceleration * period;
  const double root = c + std::sqrt(c * c + 4.0 * k * at);  // 2 A T / v
  return root > 0.0 ? 2.0 * at / root : std::numeric_limits<double>::infinity();
}

double corner_ripple_feedrate(double turn, double jerk, double period) noexcept {
  return turn > 0.0 ? 2.0 * kRipple * jerk * period * period / (turn * turn)
                    : std::numeric_limits<double>::infinity();
}

}  // namespace twin::feedrate
