#include "feedrate/limits/local_geometry.hpp"

#include <cmath>

namespace twin::feedrate {
namespace {

constexpr double kVertical = 1e-6;  // level share below which there is no heading

}  // namespace

LocalGeometry local_geometry(const path::PathPoint& at) noexcept {
  const Vec3& t = at.tangent;
  const Vec3& c = at.curvature;
  const double level = std::hypot(t.x(), t.y());
  const double cross = t.x() * c.y() - t.y() * c.x();
  return {c.norm(), level, level > kVertical ? cross / (level * level) : 0.0};
}

}  // namespace twin::feedrate
