#pragma once

#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/nurbs/curve.hpp"
#include "geometry/nurbs/fit.hpp"

namespace twin::geometry {

/// Interpolates points with cubic Bezier pieces that join with continuous tangent.
///
/// One piece from point to point; at each point the tangent is that of the circle through it and
/// its two neighbours, with chords of lengths a (before) and b (after) in directions e and f
///   T = (b e + a f) / |b e + a f|,
/// at a free end that of the circle through the first (last) three points. The inner control points
/// lie a third of the chord away along the tangent, so C' = T at the ends of every piece with
/// respect to chord length. C'' jumps from piece to piece. This is the local fit that [WY09]
/// attributes to its reference [8], Fast Bezier interpolation; how [8] finds its tangents is not
/// said there.
///
/// The result is one curve of degree 3 with chord length as parameter and every inner knot twice: a
/// Bezier piece a span.
class BezierFitter {
 public:
  /// Fits the curve through `points` (n+1 of them [mm], successive ones distinct); n >= 2, or n >=
  /// 1 with a clamped end. Of an end condition the first derivative counts alone.
  ///
  /// @param out  gets the curve; untouched on failure
  /// @returns false when the points are too few, coincide or are not finite
  bool fit(std::span<const Vec3> points, const EndCondition& begin, const EndCondition& end,
           Curve& out);

  /// Chord-length parameters of the last fit [mm].
  const std::vector<double>& parameters() const noexcept { return parameters_; }

 private:
  std::vector<double> parameters_;
  std::vector<Vec3> tangents_;
};

/// Condition at the middle one of three points: the tangent of the circle through them, unit
/// vector.
EndCondition circle_condition(const Vec3& before, const Vec3& at, const Vec3& after);

}  // namespace twin::geometry
