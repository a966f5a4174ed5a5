#pragma once

#include <vector>

#include "nc_programs/generate/fair_curve.hpp"

namespace twin::programs {

/// NURBS curve in the plane, C(u) = A(u) / w(u) with the homogeneous B-spline (A, w) = sum_i N_i(u)
/// (w_i P_i, w_i).
///
/// Derivatives by the quotient rule:
///   C' = (A' - w' C) / w,   C'' = (A'' - 2 w' C' - w'' C) / w.
class RationalCurve {
 public:
  /// @param points   control points P_i [mm]
  /// @param weights  w_i > 0, as many
  /// @param knots    clamped
  RationalCurve(int degree, const std::vector<Point2>& points, const std::vector<double>& weights,
                const std::vector<double>& knots);

  /// Point C(u) [mm].
  [[nodiscard]] Point2 point(double u) const;
  /// |C'(u)| [mm per unit of u].
  [[nodiscard]] double speed(double u) const;
  /// Place, unit tangent and curvature at u.
  [[nodiscard]] Frame at(double u) const;
  [[nodiscard]] const std::vector<double>& knots() const { return curve_.knots; }

 private:
  BSpline<3> curve_, first_, second_;
};

/// Linearises the curve from end to end so that no point of it is farther than `tolerance` from its
/// chord.
///
/// Greedy: each chord is as long as the tolerance and `longest` allow (bisection in u, distance
/// looked at in kProbes places). The tolerance is then lowered as far as the number of chords
/// allows, so that no short one is left over.
/// @param tolerance  chord tolerance [mm]
/// @param longest    largest chord [mm]
std::vector<Point2> linearise(const RationalCurve& curve, double tolerance, double longest);

}  // namespace twin::programs
