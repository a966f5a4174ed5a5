#include "feedrate/limits/curvature_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twin::feedrate {

double critical_curvature(double acceleration, double feedrate) noexcept {
  return acceleration / (feedrate * feedrate);
}

double servo_model_feedrate(double curvature, const PlanningModel& model) noexcept {
  const double shrink = std::max(1.0 - curvature * model.circular_error, 0.0);
  const double below = shrink * shrink - model.kf * model.kf;
  if (!(curvature > 0.0) || below <= 0.0) {
    return std::numeric_limits<double>::infinity();
  }
  const double omega = model.kp * std::sqrt((1.0 - shrink * shrink) / below);
  return omega / curvature;
}

double curvature_feedrate(double curvature, double feedrate, const PlanningModel& model,
                          const Limits& limits) noexcept {
  if (curvature < critical_curvature(limits.acceleration, feedrate)) {
    return feedrate;
  }
  return std::min({feedrate, servo_model_feedrate(curvature, model),
                   std::sqrt(limits.acceleration / curvature)});
}

}  // namespace twin::feedrate
