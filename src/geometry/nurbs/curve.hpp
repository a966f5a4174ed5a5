#pragma once

#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "geometry/nurbs/derivatives.hpp"
#include "geometry/nurbs/knot_vector.hpp"

namespace twin::geometry {

/// A non-uniform rational B-spline curve of degree p [WY09, Eqs. 7, 11]:
///   C(u) = sum_i R_{i,p}(u) P_i,   u_min <= u <= u_max,
///   R_{i,p} = N_{i,p} w_i / sum_j N_{j,p} w_j,
/// with control points P_i and weights w_i, i = 0..n, on a non-periodic knot vector U
/// [WY09, Eq. 8]. The domain is the range of the knots. Curves that Fitter makes have chord length
/// as their parameter, 0 <= u <= L [mm].
///
/// Evaluation accepts any double: u is clamped to the domain, and NaN to its beginning. At a knot
/// the derivatives are those of the span that begins there, at u_max those of the last span.
class Curve {
 public:
  /// A curve of no points, to be assigned to; it must not be evaluated.
  Curve() = default;

  /// @param degree          degree p, 1..kMaxDegree
  /// @param knots           U, n + p + 2 values
  /// @param control_points  P_0..P_n, n >= p [mm]
  /// @param weights         w_0..w_n > 0, or empty: all 1
  /// @returns the curve, or what is wrong with the data
  static Expected<Curve> create(int degree, std::vector<double> knots,
                                std::vector<Vec3> control_points, std::vector<double> weights = {});

  int degree() const noexcept { return degree_; }
  const std::vector<double>& knots() const noexcept { return knots_; }
  const std::vector<Vec3>& control_points() const noexcept { return control_points_; }  ///< [mm]

  /// Weights w_i; empty when they are all equal, for then the curve is an ordinary B-spline.
  const std::vector<double>& weights() const noexcept { return weights_; }
  bool is_rational() const noexcept { return !weights_.empty(); }
  bool is_empty() const noexcept { return control_points_.empty(); }

  double u_min() const noexcept { return knots_.front(); }
  double u_max() const noexcept { return knots_.back(); }

  /// Span that holds u, see geometry::find_span; `hint` is the span of an earlier call.
  /// @note Real-time safe.
  int find_span(double u, int hint = -1) const noexcept {
    return geometry::find_span(degree_, knots_, u, hint);
  }

  /// C(u) [mm]. @note Real-time safe.
  Vec3 position(double u, int span_hint = -1) const noexcept;

  /// C(u), C'(u), C''(u). @note Real-time safe.
  Derivatives derivatives(double u, int span_hint = -1) const noexcept;

  /// The data of one span, p <= span <= n. @note Real-time safe.
  SpanView span_view(int span) const noexcept {
    return {knots_.data() + span, control_points_.data() + (span - degree_),
            weights_.empty() ? nullptr : weights_.data() + (span - degree_)};
  }

 private:
  // Fitter fills the arrays of an old curve again, without the checks of create().
  friend class Fitter;

  double clamped(double u) const noexcept;

  int degree_ = 0;
  std::vector<double> knots_;
  std::vector<Vec3> control_points_;
  std::vector<double> weights_;
};

/// The full circle parallel to the XY plane, counter-clockwise from (centre.x + radius, centre.y),
/// as an exact rational curve on 0 <= u <= 1 with one quarter to each 1/4 of u.
///
/// A quarter is the rational parabola with control points A, B, C, where B is the meeting point of
/// the tangents in A and C, and weights 1, cos 45 deg, 1. Degree 3 is the same curve with the
/// degree of each quarter raised by one. In homogeneous coordinates its control points are
///   A,   (A + 2 B) / 3,   (2 B + C) / 3,   C.
///
/// @param centre  centre [mm]
/// @param radius  radius > 0 [mm]
/// @param degree  2 or 3
Expected<Curve> full_circle(const Vec3& centre, double radius, int degree = 2);

}  // namespace twin::geometry
