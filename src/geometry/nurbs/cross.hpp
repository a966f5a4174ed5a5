#pragma once

#include "core/vec.hpp"

namespace twin::geometry {

/// Cross product a x b; Eigen's own would pull in its geometry module.
inline Vec3 cross(const Vec3& a, const Vec3& b) noexcept {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}

}  // namespace twin::geometry
