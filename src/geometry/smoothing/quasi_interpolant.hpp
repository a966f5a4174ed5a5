#pragma once

#include <cstddef>

#include "core/vec.hpp"
#include "geometry/nurbs/span_cubic.hpp"
#include "geometry/smoothing/knot_marcher.hpp"
#include "geometry/smoothing/sliding_vector.hpp"

namespace twin::geometry {

/// A span of the spline is final once this many knots after its begin have been placed.
inline constexpr std::size_t kReach = 5;

/// Computes the control points of a run's spline on the knots of a KnotMarcher. The spline is a
/// quasi-interpolant with one correction.
///
/// Let N_j be the cubic B-spline on the knots t_j .. t_{j+4}, and
///   Q_j[f] = the blossom at (t_{j+1}, t_{j+2}, t_{j+3}) of the cubic that fits f best on
///            [t_{j+1}, t_{j+3}] (LocalCubic).                                                 (1)
/// The spline Q[f] = sum_j Q_j[f] N_j equals f if f is a cubic, and averages the rounding of the
/// points. From any other curve f it deviates everywhere by about 0.031 H^4 |d4f/ds4|, where H is
/// the length of a span. Applying Q to Q[f] makes the same error again. So Q[f] - Q[Q[f]] measures
/// the error, and adding it to Q[f] removes the error to first order:
///   C(s) = sum_j P_j N_j(s),   P_j = 2 Q_j[V] - Q_j[Q[V]].                                     (2)
/// P_j depends on the six spans around it alone. No system of equations is solved, and a change far
/// away has no effect.
///
/// Beyond both ends of the run the polygon, the knots and the control points go on as their own
/// point reflection. So C passes through the end point, with C'' = 0.
class QuasiInterpolant {
 public:
  /// @param knots  of the same run; they outlive this object
  explicit QuasiInterpolant(KnotMarcher& knots) : knots_(knots) {}

  /// Begins a run at a point [mm].
  void begin_at(const Vec3& at);

  /// Computes the control points that are determined by the knots placed so far.
  void extend(const KnownRun& run);

  /// C on one span.
  /// @pre kReach knots after the begin of the span have been placed, or all knots of the run
  SpanCubic cubic(std::size_t span) const noexcept { return cubic_of(points_, span); }

  /// Removes the control points that depend on knots after index `last`.
  void truncate(std::size_t last);
  /// Removes the control points before index j, which are not needed any more.
  void drop_before(std::size_t j);

 private:
  void correct(const KnownRun& run);
  Vec3 refitted(std::size_t i) const noexcept;
  SpanCubic cubic_of(const SlidingVector<Vec3>& points, std::size_t span) const noexcept;

  KnotMarcher& knots_;
  Vec3 begin_ = Vec3::Zero();   // first point of the run [mm]
  SlidingVector<Vec3> raw_;     // Q_{j-3} at index j
  SlidingVector<Vec3> points_;  // P_{j-3} at index j
};

}  // namespace twin::geometry
