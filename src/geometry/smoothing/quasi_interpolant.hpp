#pragma once

#include <cstddef>

#include "core/vec.hpp"
#include "geometry/nurbs/span_cubic.hpp"
#include "geometry/smoothing/knot_marcher.hpp"
#include "geometry/smoothing/sliding_vector.hpp"

namespace twin::geometry {

/// A span of the spline is decided once this many knots after its begin are placed.
inline constexpr std::size_t kReach = 5;

/// Control points of a run's spline on the knots of a KnotMarcher: a quasi-interpolant, corrected
/// once.
///
/// With N_j the cubic B-spline on t_j .. t_{j+4} and
///   Q_j[f] = the blossom at (t_{j+1}, t_{j+2}, t_{j+3}) of the cubic that is nearest to f on
///            [t_{j+1}, t_{j+3}] (LocalCubic),                                                 (1)
/// the spline Q[f] = sum_j Q_j[f] N_j is f itself where f is a cubic, and averages the rounding of
/// the points. Off any other curve f it lies by 0.031 H^4 |d4f/ds4|, all along. Applying Q to Q[f]
/// repeats that error, so the difference Q[f] - Q[Q[f]] measures it, and adding the difference to
/// Q[f] takes it out to first order:
///   C(s) = sum_j P_j N_j(s),   P_j = 2 Q_j[V] - Q_j[Q[V]].                                     (2)
/// P_j depends on the six spans around it: no system of equations is solved, and a change far away
/// has no effect.
///
/// At both ends of the run the polygon goes on as its own point reflection, and so do knots and
/// points. There C is the end point itself, and C'' = 0.
class QuasiInterpolant {
 public:
  /// @param knots  of the same run; they outlive this object
  explicit QuasiInterpolant(const KnotMarcher& knots) : knots_(knots) {}

  /// Begins a run at a point, before its first span.
  void begin_at(const Vec3& at);

  /// Computes the points that the latest knot decides.
  void extend(const KnownRun& run);

  /// C on one span. @pre kReach knots after its begin are placed, or all there are.
  SpanCubic cubic(std::size_t span) const noexcept { return cubic_of(points_, span); }

  /// Forgets the points that depend on knots after `last`.
  void truncate(std::size_t last);
  /// Forgets the points before index j.
  void drop_before(std::size_t j);

 private:
  void correct(const KnownRun& run);
  Vec3 refitted(std::size_t i) const noexcept;
  SpanCubic cubic_of(const SlidingVector<Vec3>& points, std::size_t span) const noexcept;

  const KnotMarcher& knots_;
  Vec3 begin_ = Vec3::Zero();   // place where the run begins
  SlidingVector<Vec3> raw_;     // Q_{j-3} at index j
  SlidingVector<Vec3> points_;  // P_{j-3} at index j
};

}  // namespace twin::geometry
