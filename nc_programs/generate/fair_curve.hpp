#pragma once

#include <vector>

#include "nc_programs/generate/bspline.hpp"

namespace twin::programs {

using Point2 = Eigen::Vector2d;  ///< (x, y) [mm]

/// Position, unit tangent and signed curvature of a plane curve at one place.
struct Frame {
  Point2 point;      ///< [mm]
  Point2 tangent;    ///< unit vector
  double curvature;  ///< kappa, positive to the left [1/mm]
};

/// Smooth curve near a few sketch points.
///
/// Of all quintic B-splines C over the chord-length parameters t_i of the sketch points p_i, the
/// one that minimises
///   sum_i w_i |C(t_i) - p_i|^2 + lambda integral |C'''(t)|^2 dt,
/// with a large w at both ends. The third derivative is close to the change of curvature along the
/// curve, so lambda irons out what an unsteady hand puts into the curvature and leaves the shape
/// alone.
class FairCurve {
 public:
  /// @param sketch  at least 3 points from end to end [mm]
  /// @param lambda  smoothing [mm^5]; 0 would interpolate
  FairCurve(const std::vector<Point2>& sketch, double lambda);

  /// The same curve, `factor` times as large.
  [[nodiscard]] FairCurve scaled(double factor) const;

  /// Place at parameter t.
  [[nodiscard]] Frame at(double t) const;
  /// |C'(t)| [mm per unit of t].
  [[nodiscard]] double speed(double t) const { return first_.at(t).norm(); }
  /// Range of the parameter t.
  [[nodiscard]] double begin() const { return curve_.first(); }
  [[nodiscard]] double end() const { return curve_.last(); }

 private:
  FairCurve() = default;
  BSpline<2> curve_, first_, second_;
};

}  // namespace twin::programs
