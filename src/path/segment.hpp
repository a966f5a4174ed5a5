#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "core/vec.hpp"
#include "geometry/arc.hpp"
#include "geometry/nurbs/arc_length.hpp"
#include "geometry/nurbs/curve.hpp"
#include "path/corner/corner_motion.hpp"

namespace twin::path {

/// A point of a path and its first two derivatives with respect to arc length.
struct PathPoint {
  Vec3 position = Vec3::Zero();   ///< [mm]
  Vec3 tangent = Vec3::UnitX();   ///< dC/ds, unit vector
  Vec3 curvature = Vec3::Zero();  ///< d2C/ds2, towards the centre of curvature [1/mm]
};

/// Straight line of a given length.
struct Line {
  Vec3 start = Vec3::Zero();       ///< [mm]
  Vec3 direction = Vec3::UnitX();  ///< unit vector; any one if the length is 0
};

/// Arc or helix, exact.
struct Arc {
  geometry::Arc geometry;
  double length = 0.0;  ///< arc length [mm]
};

/// Fitted run of short blocks, or part of a NURBS of the program, with its measured arc length.
struct FittedCurve {
  geometry::Curve curve;
  geometry::ArcLength arc_length;
  std::vector<geometry::CurvatureSample> curvature;  ///< ascending in s, both ends included
  bool is_programmed = false;                        ///< true: a NURBS of the program, not fitted
};

/// Where a block of the program ends on a segment.
struct BlockMark {
  double end = 0.0;        ///< arc length from the segment's start [mm]
  double length = 0.0;     ///< length of the block as programmed [mm]
  std::int64_t block = 0;  ///< number of the block, counted from 0
  std::int64_t line = 0;   ///< its NC line
};

/// One segment of the path: a line, an arc, a curve, the passage of a corner, or a dwell
/// (std::monostate, length 0). The length of a passage is CornerMotion::length().
struct Segment {
  std::variant<std::monostate, Line, Arc, FittedCurve, CornerMotion> geometry;
  double length = 0.0;           ///< arc length [mm]
  double feedrate = 0.0;         ///< programmed feedrate, or the rapid's [mm/s]
  double corner_error = 0.0;     ///< contour error that is allowed at the corner at its end [mm]
  double dwell = 0.0;            ///< time of the dwell; 0 for other segments [s]
  double deviation = 0.0;        ///< no point of it or of its blocks is farther from the other [mm]
  bool stops_at_end = false;     ///< the motion is at rest at its end
  bool is_rapid = false;         ///< made from G00
  PathPoint begin;               ///< its first point
  PathPoint end;                 ///< its last point
  std::vector<BlockMark> marks;  ///< the blocks that it is made of, in order
};

/// Point of a line at arc length s in [0, length].
PathPoint point_at(const Line& line, double s) noexcept;

/// Point of an arc at arc length s in [0, length].
PathPoint point_at(const Arc& arc, double s) noexcept;

/// Point of a curve at arc length s in [0, length].
PathPoint point_at(const FittedCurve& curve, double s) noexcept;

/// Converts derivatives with respect to a curve's parameter to those with respect to arc length.
PathPoint point_from(const geometry::Derivatives& at) noexcept;

/// Adds its arc length to an arc.
Arc make_arc(const geometry::Arc& geometry) noexcept;

/// The exact part of an arc between the arc lengths `from` and `to` [mm].
Arc part_of(const Arc& arc, double from, double to) noexcept;

/// Computes arc_length and curvature of a curve that was just fitted.
void measure(FittedCurve& fitted, geometry::Sampling sampling = geometry::Sampling::kEven);

/// The part of a measured curve between the arc lengths `from` and `to`, measured itself [mm].
FittedCurve part_of(const FittedCurve& curve, double from, double to);

/// Makes a segment from a curve after measure(): geometry, length and both ends.
Segment make_curve_segment(FittedCurve&& fitted);

}  // namespace twin::path
