#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "gcode/block.hpp"

/// Blocks for the tests of this folder.
namespace twin::results {

inline gcode::Block line(const Vec3& start, const Vec3& end) {
  gcode::Block block;
  block.start = start;
  block.end = end;
  return block;
}

/// Arc from a start point about an axis through the centre. @param sweep > 0 [rad] @param rise [mm]
inline gcode::Block arc(const Vec3& start, const Vec3& centre, const Vec3& axis, double sweep,
                        double rise = 0.0) {
  gcode::Block block;
  block.motion = gcode::Motion::kArc;
  block.start = start;
  block.arc.centre = centre;
  block.arc.radius = (start - centre).norm();
  block.arc.e1 = (start - centre).normalized();
  block.arc.e2 = axis.normalized().cross(block.arc.e1);
  block.arc.sweep = sweep;
  block.arc.rise = rise;
  block.end = centre +
              block.arc.radius * (std::cos(sweep) * block.arc.e1 + std::sin(sweep) * block.arc.e2) +
              rise * axis.normalized();
  return block;
}

}  // namespace twin::results
