#include "studies/circular/deviations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/circular/polar_path.hpp"

namespace twin::studies::circular {
namespace {

SenseDeviations evaluate_sense(std::span<const Vec2> path, double radius) {
  SenseDeviations result;
  result.circular = minimum_zone(path).separation;
  const auto [nearest, farthest] =
      std::ranges::minmax_element(path, {}, [](const Vec2& point) { return point.norm(); });
  result.radial_max = farthest->norm() - radius;
  result.radial_min = nearest->norm() - radius;
  result.least_squares = least_squares_circle(path);
  return result;
}

/// Largest difference of the radii where the first path has a point.
double largest_difference(const PolarPath& first, const PolarPath& second) {
  double largest = 0.0;
  for (const PolarPoint& point : first.points()) {
    largest = std::max(largest, std::abs(point.radius - second.radius_at(point.angle)));
  }
  return largest;
}

}  // namespace

Deviations evaluate(const BothPaths& paths, double radius) {
  Deviations result;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    result.sense[i] = evaluate_sense(paths[i], radius);
  }
  std::vector<Vec2> both = paths[0];
  both.insert(both.end(), paths[1].begin(), paths[1].end());
  const Circle circle = least_squares_circle(both);
  result.bidirectional = minimum_zone(both).separation;
  result.mean_radial = circle.radius - radius;
  const PolarPath first(paths[0], circle.centre);
  const PolarPath second(paths[1], circle.centre);
  result.hysteresis =
      std::max(largest_difference(first, second), largest_difference(second, first));
  return result;
}

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
