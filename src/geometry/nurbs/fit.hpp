#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/nurbs/curve.hpp"

namespace twin::geometry {

/// Row r of a matrix with two diagonals on either side of the main one: elements (r, r-2) .. (r,
/// r+2). Elements that would lie outside the matrix are ignored.
using BandRow = std::array<double, 5>;

/// Solves A x = b for three right-hand sides at once, by elimination without exchange of rows.
///
/// Collocation matrices of B-splines are totally positive; for those the growth of rounding errors
/// without pivoting is no worse than with it, and the band does not widen: O(n).
///
/// @param rows  A (n x n), destroyed
/// @param x     in: b, out: x; one row of three columns each (n x 3)
/// @note Real-time safe.
void solve_pentadiagonal(std::span<BandRow> rows, std::span<Vec3> x) noexcept;

/// What a fitted curve must do at one of its ends beyond passing through the point there.
struct EndCondition {
  bool clamped = false;        ///< whether first and second derivative are prescribed
  Vec3 first = Vec3::Zero();   ///< dC/dl, l chord length [-]
  Vec3 second = Vec3::Zero();  ///< d2C/dl2 [1/mm]
};

/// Whether points have a curve through them.
enum class FitResult : std::uint8_t {
  kFitted,
  kTooFewPoints,   ///< for the degree and the end conditions
  kInvalidPoints,  ///< successive points coincide, or one is not finite
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
/// At l_i only the basis functions of five neighbouring columns differ from zero, so the
/// collocation matrix of [WY09, Eq. 12] has five diagonals. It is totally positive, and so needs no
/// pivoting (solve_pentadiagonal).
///
/// A fitter keeps its work arrays. Once it has fitted its largest run of points it allocates
/// nothing more, unless the curve that it fills is an empty one.
class Fitter {
 public:
  /// Fits the curve through `points` (n+1 of them [mm], successive ones distinct);
  /// n >= 3, or n >= 1 with a clamped end.
  ///
  /// @param out  gets the curve, in the memory that it has; untouched if there is none
  FitResult fit(std::span<const Vec3> points, const EndCondition& begin, const EndCondition& end,
                Curve& out);

  /// Chord-length parameters l_0..l_n of the last fit [mm].
  const std::vector<double>& parameters() const noexcept { return parameters_; }

  /// Derivatives of the curve through a window of points at one of them; see joint_condition.
  EndCondition condition_at(std::span<const Vec3> window, std::size_t index);

 private:
  /// @returns false where successive points coincide or one is not finite
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
/// Four points on either side are enough, since the effect of a point on the derivatives falls by a
/// factor of about 4 with each chord. A window of three points gives the derivatives of the
/// parabola through them, one of two points those of the straight line.
///
/// @param window  points of the run around the joint, successive ones distinct [mm]
/// @param index   which of them is the joint
/// @returns the condition; not clamped when the window has no curve (see Fitter::fit)
EndCondition joint_condition(Fitter& fitter, std::span<const Vec3> window, std::size_t index);

}  // namespace twin::geometry
