#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/nurbs/banded.hpp"
#include "geometry/nurbs/curve.hpp"

namespace twin::geometry {

/// What a fitted curve must do at one of its ends beyond passing through the point there.
struct EndCondition {
  bool clamped = false;        ///< whether first and second derivative are prescribed
  Vec3 first = Vec3::Zero();   ///< dC/dl, l chord length [-]
  Vec3 second = Vec3::Zero();  ///< d2C/dl2 [1/mm]
};

/// Interpolates points with cubic B-spline curves.
///
/// Through points C_0..C_n goes the curve of degree 3 with chord length as parameter [WY09, Eq. 13,
/// without the division by L, Eq. 14],
///   l_0 = 0,   l_i = l_{i-1} + |C_i - C_{i-1}|,   domain 0 <= u <= l_n [mm],
/// and averaged knots [WY09, Eq. 15]. A clamped end also has given C' and C'': it counts as three
/// conditions, and its parameter stands three times in the averaging. So two curves with the same
/// condition at their common point join with continuous second derivative with respect to the same
/// parameter, hence with continuous tangent and curvature.
///
///     conditions   C_0 (C'_0 C''_0)  C_1 ... C_{n-1}  (C''_n C'_n) C_n
///     control      P_0 (P_1  P_2)    ...              (P_{m-2} P_{m-1}) P_m
///     found        from the end      by Eq. 12        from the end
///
/// At l_i no more than the basis functions of the five neighbouring columns differ from zero, so
/// the collocation matrix of [WY09, Eq. 12] has five diagonals; it is totally positive
/// (solve_pentadiagonal).
///
/// A fitter keeps its work arrays: it allocates nothing once it has seen its largest run of points,
/// except where the curve it fills was moved away.
class Fitter {
 public:
  /// Fits the curve through `points` (n+1 of them [mm], successive ones distinct);
  /// n >= 3, or n >= 1 with a clamped end.
  ///
  /// @param out  gets the curve; untouched on failure
  /// @returns false when the points are too few, coincide or are not finite
  bool fit(std::span<const Vec3> points, const EndCondition& begin, const EndCondition& end,
           Curve& out);

  /// Chord-length parameters l_0..l_n of the last fit [mm].
  const std::vector<double>& parameters() const noexcept { return parameters_; }

  /// What the curve through a window of points does at one of them; see joint_condition.
  EndCondition condition_at(std::span<const Vec3> window, std::size_t index);

 private:
  bool set_parameters(std::span<const Vec3> points);
  void set_rows(std::span<const Vec3> points, std::size_t first_unknown, const Curve& curve,
                std::span<Vec3> solution);

  std::vector<double> parameters_;  // l_0..l_n
  std::vector<double> conditions_;  // the parameters, each as often as there are conditions there
  std::vector<BandRow> rows_;
  Curve window_curve_;
};

/// Tangent and curvature for a joint at window[index]: derivatives with respect to chord length of
/// the curve that interpolates the window with free ends. Both curves that meet there get the
/// condition, one as its end, the other as its beginning.
///
/// Four points on either side are enough: what a point does to the derivatives fades by a factor of
/// about 4 with each chord. Of three points the parabola is taken, of two the straight line.
///
/// @param window  points of the run around the joint, successive ones distinct [mm]
/// @param index   which of them is the joint
/// @returns the condition; not clamped when the window has no curve (see Fitter::fit)
EndCondition joint_condition(Fitter& fitter, std::span<const Vec3> window, std::size_t index);

}  // namespace twin::geometry
