#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "core/vec.hpp"
#include "geometry/arc.hpp"
#include "geometry/nurbs/arc_length.hpp"
#include "geometry/nurbs/curve.hpp"

namespace twin::path {

/// Place of a path with its first two derivatives with respect to arc length.
struct PathPoint {
  Vec3 position = Vec3::Zero();   ///< [mm]
  Vec3 tangent = Vec3::UnitX();   ///< dC/ds, unit vector
  Vec3 curvature = Vec3::Zero();  ///< d2C/ds2, towards the centre of curvature [1/mm]
};

/// Straight line of a given length.
struct Line {
  Vec3 start = Vec3::Zero();       ///< [mm]
  Vec3 direction = Vec3::UnitX();  ///< unit vector; any, where the length is 0
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
  bool is_programmed = false;                        ///< it is of the program, not fitted
};

/// Where a block of the program ends on a segment.
struct BlockMark {
  double end = 0.0;        ///< arc length from the segment's start [mm]
  double length = 0.0;     ///< length of the block as programmed [mm]
  std::int64_t block = 0;  ///< number of the block, counted from 0
  std::int64_t line = 0;   ///< its NC line
};

/// One piece of the path: line, arc or curve; or a rest (no length, std::monostate).
struct Segment {
  std::variant<std::monostate, Line, Arc, FittedCurve> geometry;
  double length = 0.0;        ///< arc length [mm]
  double feedrate = 0.0;      ///< programmed feedrate, or the rapid's [mm/s]
  double corner_error = 0.0;  ///< corner error allowed at its end [mm]
  double dwell = 0.0;         ///< time at rest [s], where it is a rest
  double deviation = 0.0;     ///< bound of its distance from the programmed path, both ways [mm]
  bool stops_at_end = false;  ///< the feedrate is zero at its end
  bool is_rapid = false;
  PathPoint begin;               ///< its first place
  PathPoint end;                 ///< its last place
  std::vector<BlockMark> marks;  ///< the blocks it is made of, in order
};

/// Place at arc length s in [0, length] of a line.
PathPoint point_at(const Line& line, double s) noexcept;

/// Place at arc length s in [0, length] of an arc.
PathPoint point_at(const Arc& arc, double s) noexcept;

/// Place at which a curve has these derivatives with respect to its parameter.
PathPoint point_from(const geometry::Derivatives& at) noexcept;

/// Measures an arc.
Arc make_arc(const geometry::Arc& geometry) noexcept;

/// Part of an arc between two of its arc lengths, exact.
Arc part_of(const Arc& arc, double from, double to) noexcept;

/// Fills arc length and curvature of a curve that was just fitted.
void measure(FittedCurve& fitted);

/// Segment of a measured curve: geometry, length and both ends.
Segment make_curve_segment(FittedCurve&& fitted);

}  // namespace twin::path
