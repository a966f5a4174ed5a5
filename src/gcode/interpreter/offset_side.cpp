#include "gcode/interpreter/offset_side.hpp"

#include <cmath>

namespace twin::gcode {
namespace {

Vec2 left_of(const Vec2& tangent) { return {-tangent.y(), tangent.x()}; }

std::optional<Vec2> nearest(const Vec2& base, const Vec2& across, double half, const Vec2& corner) {
  const Vec2 one = base + half * across;
  const Vec2 other = base - half * across;
  return (one - corner).squaredNorm() <= (other - corner).squaredNorm() ? one : other;
}

/// A line through a point and a circle.
std::optional<Vec2> line_and_circle(const Vec2& point, const Vec2& direction, const Vec2& centre,
                                    double radius, const Vec2& corner) {
  const Vec2 foot = point + direction.dot(centre - point) * direction;
  const double half_squared = radius * radius - (centre - foot).squaredNorm();
  if (half_squared < 0.0) {
    return std::nullopt;
  }
  return nearest(foot, direction, std::sqrt(half_squared), corner);
}

std::optional<Vec2> two_circles(const Vec2& centre, double radius, const Vec2& other_centre,
                                double other_radius, const Vec2& corner) {
  const Vec2 between = other_centre - centre;
  const double distance = between.norm();
  if (distance < kNoLength) {
    return std::nullopt;
  }
  const Vec2 direction = between / distance;
  const double along =
      (distance * distance + radius * radius - other_radius * other_radius) / (2.0 * distance);
  const double half_squared = radius * radius - along * along;
  if (half_squared < 0.0) {
    return std::nullopt;
  }
  return nearest(centre + along * direction, left_of(direction), std::sqrt(half_squared), corner);
}

}  // namespace

OffsetSide::OffsetSide(const Block& block, const PlaneAxes& axes, double distance)
    : d_(distance),
      contour_first_(in_plane(block.start, axes)),
      contour_last_(in_plane(block.end, axes)) {
  if (block.motion != Motion::kArc) {
    first_tangent_ = last_tangent_ = (contour_last_ - contour_first_).normalized();
    return;
  }
  const Vec2 e1 = in_plane(block.arc.e1, axes);
  const Vec2 e2 = in_plane(block.arc.e2, axes);
  turn_ = cross(e1, e2) > 0.0 ? 1.0 : -1.0;
  centre_ = in_plane(block.arc.centre, axes);
  sweep_ = block.arc.sweep;
  first_tangent_ = e2;
  last_tangent_ = std::cos(sweep_) * e2 - std::sin(sweep_) * e1;
}

Vec2 OffsetSide::first() const noexcept { return contour_first_ + d_ * left_of(first_tangent_); }

Vec2 OffsetSide::last() const noexcept { return contour_last_ + d_ * left_of(last_tangent_); }

bool OffsetSide::is_sound() const noexcept {
  return !is_arc() || (first_radius() > kNoLength && last_radius() > kNoLength);
}

void OffsetSide::move_centre(const Vec2& centre, double sweep) noexcept {
  centre_ = centre;
  sweep_ = sweep;
}

std::optional<Vec2> meeting_point(const OffsetSide& before, const OffsetSide& after) {
  const Vec2& corner = after.contour_first_;
  if (before.is_arc() && after.is_arc()) {
    return two_circles(before.centre_, (before.last() - before.centre_).norm(), after.centre_,
                       after.first_radius(), corner);
  }
  if (before.is_arc()) {
    return line_and_circle(after.first(), after.first_tangent_, before.centre_,
                           (before.last() - before.centre_).norm(), corner);
  }
  if (after.is_arc()) {
    return line_and_circle(before.last(), before.last_tangent_, after.centre_, after.first_radius(),
                           corner);
  }
  const Vec2 normal = left_of(before.last_tangent_);
  const Vec2 sum = normal + left_of(after.first_tangent_);
  const double share = sum.dot(normal);
  if (share < 1e-12) {
    return std::nullopt;
  }
  return Vec2(corner + before.d_ / share * sum);
}

}  // namespace twin::gcode
