#include "studies/circular/servo_prediction.hpp"

#include <fmt/format.h>

#include <cmath>

namespace twin::studies::circular {

Expected<double> predicted_radial_deviation(const std::array<motion::Gains, 2>& gains,
                                            double radius, double feedrate) {
  const double w = feedrate / radius;
  double sum = 0.0;
  for (std::size_t axis = 0; axis < gains.size(); ++axis) {
    const motion::Gains& g = gains[axis];
    if (g.ka != 0.0 || g.kd != 0.0) {
      return fail(ErrorCode::kMachine,
                  fmt::format("Eq. 3 has no {}, and servo.{} has", g.ka != 0.0 ? "Ka" : "Kd",
                              axis == 0 ? 'x' : 'y'));
    }
    sum += std::sqrt((g.kf * g.kf * w * w + g.kp * g.kp) / (w * w + g.kp * g.kp)) - 1.0;
  }
  return radius * sum / static_cast<double>(gains.size());
}

}  // namespace twin::studies::circular
