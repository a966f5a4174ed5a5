#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/arc.hpp"
#include "path/smooth_builder.hpp"
#include "tests/support/blocks.hpp"

/// A smoothed path held against its program by dense sampling.
namespace twin::test {

inline std::vector<path::Segment> smooth(const std::vector<gcode::Block>& blocks,
                                         const PathSettings& settings = {},
                                         const PlanningModel& model = {},
                                         const Limits& limits = {}) {
  std::vector<path::Segment> segments;
  path::SmoothBuilder builder(settings, model, limits, [&](path::Segment&& segment) {
    segments.push_back(std::move(segment));
  });
  for (const gcode::Block& block : blocks) {
    builder.push(block);
  }
  builder.finish();
  return segments;
}

/// Place of a segment at arc length s.
inline path::PathPoint place(const path::Segment& segment, double s) {
  if (const auto* curve = std::get_if<path::FittedCurve>(&segment.geometry)) {
    return path::point_from(curve->curve.derivatives(curve->arc_length.u_at(curve->curve, s, s)));
  }
  if (const auto* arc = std::get_if<path::Arc>(&segment.geometry)) {
    return path::point_at(*arc, s);
  }
  if (const auto* line = std::get_if<path::Line>(&segment.geometry)) {
    return path::point_at(*line, s);
  }
  if (const auto* passage = std::get_if<path::CornerMotion>(&segment.geometry)) {
    const path::SpaceMotion at = path::motion_in(*passage, s, passage->feedrate, 0.0);
    return {at.position, at.velocity.normalized(), Vec3::Zero()};
  }
  return segment.begin;
}

/// Points of the program, `count` and more a block.
inline std::vector<Vec3> program_points(const gcode::Block& block, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i <= count; ++i) {
    const double f = static_cast<double>(i) / count;
    points.push_back(block.motion == gcode::Motion::kArc
                         ? geometry::point_at(block.arc, f)
                         : Vec3(block.start + f * (block.end - block.start)));
  }
  return points;
}

/// Points of a path, several a span.
inline std::vector<Vec3> path_points(const path::Segment& segment) {
  std::vector<Vec3> points;
  if (const auto* curve = std::get_if<path::FittedCurve>(&segment.geometry)) {
    const std::vector<double>& u = curve->curve.knots();
    for (std::size_t k = 0; k + 1 < u.size(); ++k) {
      for (int i = 0; i < 32 && u[k] < u[k + 1]; ++i) {
        points.push_back(curve->curve.position(u[k] + i / 32.0 * (u[k + 1] - u[k])));
      }
    }
    points.push_back(segment.end.position);
    return points;
  }
  for (int i = 0; i <= 64; ++i) {
    points.push_back(place(segment, segment.length * i / 64.0).position);
  }
  return points;
}

/// Distance of a point from a polyline [mm].
inline double distance_to_polyline(const Vec3& p, const std::vector<Vec3>& line) {
  double nearest = (p - line.front()).norm();
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] != line[i - 1]) {
      nearest = std::min(nearest, distance_to(p, line[i - 1], line[i]));
    }
  }
  return nearest;
}

/// Distance of a point from a block [mm].
inline double distance_to_block(const Vec3& p, const gcode::Block& block) {
  if (block.motion != gcode::Motion::kArc) {
    return distance_to(p, block.start, block.end);
  }
  constexpr int kSteps = 300;
  const auto away = [&](double f) { return (p - geometry::point_at(block.arc, f)).norm(); };
  int best = 0;
  for (int i = 1; i <= kSteps; ++i) {
    best = away(1.0 * i / kSteps) < away(1.0 * best / kSteps) ? i : best;
  }
  double low = std::max(0.0, (best - 1.0) / kSteps);
  double high = std::min(1.0, (best + 1.0) / kSteps);
  for (int i = 0; i < 60; ++i) {
    const double third = (high - low) / 3.0;
    (away(low + third) < away(high - third) ? high : low) =
        away(low + third) < away(high - third) ? high - third : low + third;
  }
  return away(0.5 * (low + high));
}

/// Rounding of the curvature of a segment: that of its coordinates over the square of its narrowest
/// span [1/mm].
inline double curvature_rounding(const path::Segment& segment) {
  double rounding = 1e-9;
  if (const auto* curve = std::get_if<path::FittedCurve>(&segment.geometry)) {
    const std::vector<double>& u = curve->curve.knots();
    for (std::size_t k = 1; k < u.size(); ++k) {
      const double w = u[k] - u[k - 1];
      if (w > 0.0) {
        rounding = std::max(rounding, 1e-14 * (1.0 + segment.begin.position.norm()) / (w * w));
      }
    }
  }
  return rounding;
}

/// Position, tangent and curvature go on from one segment to the next, unless the path rests.
inline void expect_smooth_joints(const std::vector<path::Segment>& segments) {
  for (std::size_t i = 1; i < segments.size(); ++i) {
    const path::Segment& a = segments[i - 1];
    const path::Segment& b = segments[i];
    ASSERT_LT((a.end.position - b.begin.position).norm(), 1e-9) << "joint " << i;
    if (a.stops_at_end || b.stops_at_end || a.length == 0.0 || b.length == 0.0) {
      continue;
    }
    ASSERT_LT((a.end.tangent - b.begin.tangent).norm(), 1e-6) << "joint " << i;
    const double larger = std::max(a.end.curvature.norm(), b.begin.curvature.norm());
    const double rounding = curvature_rounding(a) + curvature_rounding(b) + 1e-6 * larger;
    ASSERT_LT((a.end.curvature - b.begin.curvature).norm(), rounding) << "joint " << i;
  }
}

/// Every block has a mark, in order, and the marks of each segment ascend to its end.
inline void expect_marks(const std::vector<path::Segment>& segments, std::int64_t count) {
  std::int64_t last = -1;
  for (const path::Segment& segment : segments) {
    double before = 0.0;
    ASSERT_FALSE(segment.marks.empty());
    for (const path::BlockMark& mark : segment.marks) {
      ASSERT_TRUE(mark.block == last || mark.block == last + 1) << mark.block << " after " << last;
      ASSERT_GE(mark.end, before);
      last = mark.block;
      before = mark.end;
    }
    ASSERT_EQ(before, segment.length);
  }
  ASSERT_EQ(last, count - 1);
}

inline bool is_finite(const path::Segment& segment) {
  return std::isfinite(segment.length) && segment.begin.position.allFinite() &&
         segment.end.position.allFinite() && segment.begin.tangent.allFinite() &&
         segment.end.tangent.allFinite() && segment.begin.curvature.allFinite() &&
         segment.end.curvature.allFinite() && std::isfinite(segment.deviation);
}

/// Distance of a segment from the blocks around it, both ways, is within its bound, and the bound
/// within the tolerance.
inline void expect_within_bounds(const std::vector<path::Segment>& segments,
                                 const std::vector<gcode::Block>& blocks, double tolerance,
                                 double rounding = 1e-7) {
  for (std::size_t n = 0; n < segments.size(); ++n) {
    const path::Segment& segment = segments[n];
    ASSERT_LE(segment.deviation, tolerance * (1.0 + 1e-9)) << "segment " << n;
    // The blocks of the marks, and a millimetre's thousandth and a block more on either side.
    auto first = static_cast<std::size_t>(segment.marks.front().block);
    auto last = static_cast<std::size_t>(segment.marks.back().block);
    const auto length = [&](std::size_t i) { return (blocks[i].end - blocks[i].start).norm(); };
    for (double more = 0.0; first > 0 && more < 1e-3;) {
      more += length(--first);
    }
    for (double more = 0.0; last + 1 < blocks.size() && more < 1e-3;) {
      more += length(++last);
    }
    for (const Vec3& p : path_points(segment)) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = first; i <= last; ++i) {
        nearest = std::min(nearest, distance_to_block(p, blocks[i]));
      }
      ASSERT_LE(nearest, segment.deviation + rounding)
          << "segment " << n << " at " << p.transpose() << " blocks " << first << " to " << last
          << " length " << segment.length;
    }
  }
  for (std::size_t n = 0; n < segments.size(); ++n) {  // back from the program
    std::vector<Vec3> path;
    double bound = 0.0;
    for (std::size_t k = n > 0 ? n - 1 : 0; k <= std::min(n + 1, segments.size() - 1); ++k) {
      const auto more = path_points(segments[k]);
      path.insert(path.end(), more.begin(), more.end());
      bound = std::max(bound, segments[k].deviation);
    }
    for (const path::BlockMark& mark : segments[n].marks) {
      const bool is_inside =
          (n == 0 || segments[n - 1].marks.back().block != mark.block) &&
          (n + 1 == segments.size() || segments[n + 1].marks.front().block != mark.block);
      for (const Vec3& p : program_points(blocks[static_cast<std::size_t>(mark.block)], 8)) {
        if (is_inside) {
          ASSERT_LE(distance_to_polyline(p, path), bound + 1e-4) << "block " << mark.block;
        }
      }
    }
  }
}

}  // namespace twin::test
