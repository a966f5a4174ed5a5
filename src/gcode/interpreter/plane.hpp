#pragma once

#include "core/vec.hpp"
#include "gcode/interpreter/modal_state.hpp"

namespace twin::gcode {

/// Axis numbers of a plane in right-handed order: first, second, and the third across it.
struct PlaneAxes {
  Eigen::Index first;
  Eigen::Index second;
  Eigen::Index third;
};

constexpr PlaneAxes axes_of(Plane plane) noexcept {
  switch (plane) {
    case Plane::kZx:
      return {2, 0, 1};
    case Plane::kYz:
      return {1, 2, 0};
    default:
      return {0, 1, 2};
  }
}

inline Vec2 in_plane(const Vec3& vector, const PlaneAxes& axes) noexcept {
  return {vector[axes.first], vector[axes.second]};
}

inline Vec3 in_space(const Vec2& vector, const PlaneAxes& axes) noexcept {
  Vec3 result = Vec3::Zero();
  result[axes.first] = vector.x();
  result[axes.second] = vector.y();
  return result;
}

inline double cross(const Vec2& a, const Vec2& b) noexcept { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace twin::gcode
