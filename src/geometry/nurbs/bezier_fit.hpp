#pragma once

#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/nurbs/curve.hpp"
#include "geometry/nurbs/fit.hpp"

namespace twin::geometry {

/// Interpolates points with cubic Bezier pieces that join with continuous tangent.
///
/// There is one piece from each point to the next. The tangent at a point is that of the circle
/// through the point and its two neighbours: with chords of lengths a (before) and b (after) in
/// directions e and f,
///   T = (b e + a f) / |b e + a f|.
/// At a free end it is the tangent of the circle through the first (last) three points. The inner
/// control points lie a third of the chord away along the tangent, so C' = T at both ends of every
/// piece, with respect to chord length. C'' jumps from piece to piece. This is the local fit that
/// [WY09] attributes to its reference [8], Fast Bezier interpolation; [WY09] does not say how [8]
/// finds its tangents.
///
/// The result is one curve of degree 3 with chord length as parameter. Every inner knot stands
/// twice, so each span is a Bezier piece.
class BezierFitter {
 public:
  /// Fits the curve through `points` (n+1 of them [mm], successive ones distinct);
  /// n >= 2, or n >= 1 with a clamped end. Only the first derivative of an end condition is used.
  ///
  /// @param out  gets the curve, in the memory that it has; untouched if there is none
  FitResult fit(std::span<const Vec3> points, const EndCondition& begin, const EndCondition& end,
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
