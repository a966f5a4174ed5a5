#include "geometry/arc.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/gauss_legendre.hpp"

namespace twin::geometry {
namespace {

/// The unit vectors of an arc, turned by an angle about its axis.
struct TurnedFrame {
  Vec3 out;    // away from the axis
  Vec3 along;  // 90 deg further
};

TurnedFrame turned(const Arc& arc, double angle) noexcept {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * arc.e1 + s * arc.e2, c * arc.e2 - s * arc.e1};
}

}  // namespace

Vec3 point_at(const Arc& arc, double fraction) noexcept {
  return derivatives_at(arc, fraction).position;
}

Derivatives derivatives_at(const Arc& arc, double fraction) noexcept {
  const auto [out, along] = turned(arc, fraction * arc.sweep);
  const Vec3 axis = cross(arc.e1, arc.e2);
  const double r = arc.radius + fraction * arc.radius_change;
  return {arc.centre + r * out + fraction * arc.rise * axis,
          r * arc.sweep * along + arc.radius_change * out + arc.rise * axis,
          2.0 * arc.radius_change * arc.sweep * along - r * arc.sweep * arc.sweep * out};
}

double speed_at(const Arc& arc, double fraction) noexcept {
  const double around = (arc.radius + fraction * arc.radius_change) * arc.sweep;
  return std::sqrt(around * around + arc.radius_change * arc.radius_change + arc.rise * arc.rise);
}

double length_to(const Arc& arc, double fraction) noexcept {
  using FourPoints = gauss::Rule<4>;
  double sum = 0.0;
  for (const std::size_t i : {1U, 0U}) {  // in pairs, from the inner one to the outer
    sum += FourPoints::kWeights[i] *
           (speed_at(arc, 0.5 * fraction * (1.0 + FourPoints::kNodes[i])) +
            speed_at(arc, 0.5 * fraction * (1.0 + FourPoints::kNodes[3 - i])));
  }
  return 0.5 * fraction * sum;
}

double fraction_at(const Arc& arc, double s, double length) noexcept {
  double fraction = s / length;
  if (arc.radius_change != 0.0) {
    for (int i = 0; i < 3; ++i) {
      fraction += (s - length_to(arc, fraction)) / speed_at(arc, fraction);
    }
  }
  return std::clamp(fraction, 0.0, 1.0);
}

Arc part_of(const Arc& arc, double from, double to) noexcept {
  const auto [out, along] = turned(arc, from * arc.sweep);
  Arc part;
  part.e1 = out;
  part.e2 = along;
  part.centre = arc.centre + from * arc.rise * cross(arc.e1, arc.e2);
  part.radius = arc.radius + from * arc.radius_change;
  part.radius_change = (to - from) * arc.radius_change;
  part.sweep = (to - from) * arc.sweep;
  part.rise = (to - from) * arc.rise;
  return part;
}

}  // namespace twin::geometry
