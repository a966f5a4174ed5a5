#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "path/path_builder.hpp"

namespace twin::test {

inline gcode::Block line_block(const Vec3& start, const Vec3& end, double feedrate = 50.0) {
  gcode::Block block;
  block.start = start;
  block.end = end;
  block.feedrate = feedrate;
  return block;
}

/// Arc in the XY plane that leaves `start` in a direction and turns left or right.
inline gcode::Block arc_block(const Vec3& start, const Vec3& direction, double radius, double sweep,
                              bool is_left, double feedrate = 50.0, double rise = 0.0) {
  gcode::Block block;
  const double side = is_left ? 1.0 : -1.0;
  const Vec3 inward = side * Vec3(-direction.y(), direction.x(), 0.0);
  block.motion = gcode::Motion::kArc;
  block.arc = {start + radius * inward, -inward, direction, radius, 0.0, sweep, side * rise};
  block.start = start;
  block.end = block.arc.centre +
              radius * (std::cos(sweep) * block.arc.e1 + std::sin(sweep) * block.arc.e2) +
              Vec3(0.0, 0.0, rise);
  block.feedrate = feedrate;
  return block;
}

inline gcode::Block dwell_block(const Vec3& place, double duration) {
  gcode::Block block;
  block.motion = gcode::Motion::kDwell;
  block.start = block.end = place;
  block.dwell = duration;
  return block;
}

/// G01 blocks through the points; block i has NC line i + 1.
inline std::vector<gcode::Block> polyline(const std::vector<Vec3>& points, double feedrate = 50.0) {
  std::vector<gcode::Block> blocks;
  for (std::size_t i = 1; i < points.size(); ++i) {
    blocks.push_back(line_block(points[i - 1], points[i], feedrate));
    blocks.back().line = static_cast<std::int64_t>(i);
  }
  return blocks;
}

/// Points on a circle about the origin, `count` chords of about `chord` mm.
inline std::vector<Vec3> circle_points(double radius, double chord, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i <= count; ++i) {
    const double angle = i * chord / radius;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  }
  return points;
}

/// Points of a walk with chords between two lengths (log-uniform) and turns of up to `turn` rad.
inline std::vector<Vec3> random_walk(std::mt19937& random, int count, double shortest,
                                     double longest, double turn) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<Vec3> points{Vec3::Zero()};
  double heading = 0.0;
  for (int i = 0; i < count; ++i) {
    const double length = shortest * std::pow(longest / shortest, part(random));
    points.push_back(points.back() + length * Vec3(std::cos(heading), std::sin(heading), 0.0));
    heading += turn * (2.0 * part(random) - 1.0);
  }
  return points;
}

inline std::vector<path::Segment> build(const std::vector<gcode::Block>& blocks,
                                        const PathSettings& settings = {},
                                        const PlanningModel& model = {},
                                        const Limits& limits = {}) {
  std::vector<path::Segment> segments;
  path::PathBuilder builder(settings, model, limits, [&](path::Segment&& segment) {
    segments.push_back(std::move(segment));
  });
  for (const gcode::Block& block : blocks) {
    builder.push(block);
  }
  builder.finish();
  return segments;
}

inline bool is_curve(const path::Segment& segment) {
  return std::holds_alternative<path::FittedCurve>(segment.geometry);
}
inline bool is_line(const path::Segment& segment) {
  return std::holds_alternative<path::Line>(segment.geometry);
}

/// Distance of a point from the straight piece a b [mm].
inline double distance_to(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const double along = std::clamp((p - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (p - a - along * way).norm();
}

}  // namespace twin::test
