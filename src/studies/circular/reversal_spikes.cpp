#include "studies/circular/reversal_spikes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/linear_algebra.hpp"
#include "core/units.hpp"
#include "studies/circular/polar_path.hpp"

namespace twin::studies::circular {
namespace {

constexpr double kSpikeTime = 0.05;                        // [s]
constexpr double kLeastReach = units::rad_from_deg(15.0);  // [rad]
constexpr double kMostReach = units::rad_from_deg(45.0);
constexpr double kBefore = units::rad_from_deg(2.0);  // of the reversal

using Coefficients = Eigen::Matrix<double, 5, 1>;

Coefficients harmonics(double angle) {
  return {1.0, std::cos(angle), std::sin(angle), std::cos(2.0 * angle), std::sin(2.0 * angle)};
}

/// Angle behind the reversal that passed last, in the direction of motion, from -kBefore on.
struct Place {
  std::size_t quadrant = 0;
  double behind = 0.0;  // [rad]
};

Place place_of(double angle, Sense sense) {
  const double quarter = std::numbers::pi / 2.0;
  // Clockwise motion seen in a mirror is counter-clockwise, with 90 and 270 deg exchanged.
  const double along = wrapped(sign_of(sense) * angle + kBefore);
  const auto index = std::min<std::size_t>(static_cast<std::size_t>(along / quarter), 3);
  const double behind = along - static_cast<double>(index) * quarter - kBefore;
  return {sense == Sense::kClockwise ? (4 - index) % 4 : index, behind};
}

Coefficients fit_baseline(const std::vector<PolarPoint>& points, Sense sense, double reach) {
  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  Coefficients right = Coefficients::Zero();
  for (const PolarPoint& point : points) {
    if (place_of(point.angle, sense).behind > reach) {
      const Coefficients row = harmonics(point.angle);
      normal += row * row.transpose();
      right += row * point.radius;
    }
  }
  return solve_symmetric(normal, right);
}

/// Width of the stretch about the tip that is higher than half of it [rad].
double half_width(const std::vector<PolarPoint>& deviation, std::size_t tip) {
  const std::size_t count = deviation.size();
  const double half = 0.5 * deviation[tip].radius;
  const auto edge = [&](std::size_t step) {  // step: 1, or count - 1 for backwards
    std::size_t inside = tip;
    for (std::size_t walked = 0; walked < count; ++walked) {
      const std::size_t next = (inside + step) % count;
      const double rise = deviation[inside].radius - deviation[next].radius;
      if ((deviation[next].radius - half) * half <= 0.0) {  // crossed within this step
        const double share = rise != 0.0 ? (deviation[inside].radius - half) / rise : 0.0;
        const double gap = step == 1 ? wrapped(deviation[next].angle - deviation[inside].angle)
                                     : wrapped(deviation[inside].angle - deviation[next].angle);
        const double walked_angle = step == 1
                                        ? wrapped(deviation[inside].angle - deviation[tip].angle)
                                        : wrapped(deviation[tip].angle - deviation[inside].angle);
        return walked_angle + share * gap;
      }
      inside = next;
    }
    return 0.0;
  };
  return edge(1) + edge(count - 1);
}

}  // namespace

double spike_reach(double angular_velocity) {
  return std::clamp(angular_velocity * kSpikeTime, kLeastReach, kMostReach);
}

ReversalSpikes find_reversal_spikes(std::span<const Vec2> path, Sense sense, double reach) {
  const PolarPath polar(path, Vec2::Zero());
  std::vector<PolarPoint> deviation = polar.points();
  const Coefficients baseline = fit_baseline(deviation, sense, reach);
  ReversalSpikes result;
  std::array<std::size_t, 4> tip{};
  for (std::size_t i = 0; i < deviation.size(); ++i) {
    PolarPoint& point = deviation[i];
    point.radius -= harmonics(point.angle).dot(baseline);
    const Place place = place_of(point.angle, sense);
    Spike& spike = result.quadrant[place.quadrant];
    if (place.behind > reach) {
      result.ripple = std::max(result.ripple, std::abs(point.radius));
    } else if (std::abs(point.radius) >= std::abs(spike.height)) {
      spike.angle = point.angle;
      spike.height = point.radius;
      tip[place.quadrant] = i;
    }
  }
  for (std::size_t q = 0; q < tip.size(); ++q) {
    result.quadrant[q].width = half_width(deviation, tip[q]);
  }
  return result;
}

}  // namespace twin::studies::circular
