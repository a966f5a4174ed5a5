#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "path/segment.hpp"

namespace twin::feedrate {

/// A bend that turns by more is none that is brief [rad].
inline constexpr double kMostBriefTurn = 0.9 * std::numbers::pi;

/// A stretch of a curve between two samples of its curvature.
struct BendInterval {
  double begin;             ///< arc length from the curve's start [mm]
  double end;               ///< [mm]
  double u0;                ///< parameter at its begin
  double u1;                ///< parameter at its end
  double curvature;         ///< nowhere on the stretch is there more [1/mm]
  double turn = 0.0;        ///< of the tangent, from the curvature at both ends [rad]
  bool is_brief = false;    ///< part of a brief bend
  bool is_winding = false;  ///< part of a bend that turns by more than a corner does
};

/// The middle of a brief bend.
struct BendPeak {
  std::size_t interval;  ///< begins there
  std::size_t first;     ///< the bend's intervals are [first, last)
  std::size_t last;
  double half;  ///< half of the bend's length [mm]
  double room;  ///< half the way to the next bend of the curve [mm]
};

/// The bends of one curve. One bend ends and the next begins where the curvature has fallen to half
/// of its peak.
///
/// The curvature of a FittedCurve is sampled four times on each interval of its arc length, and the
/// intervals are divided until |C'| varies by less than 4 % (geometry/nurbs/arc_length.hpp). On a
/// curve that the planner fitted, C' x C'' is a polynomial of degree 2, so the curvature exceeds the
/// larger of two neighbouring samples by at most 0.3 %. A NURBS of the program may be rational or of
/// a high degree. There a third sample is taken in the middle, and where the parabola through the
/// three has its peak between them, the interval is halved until the parabola is nearly a line; its
/// peak bounds the curvature.
///
/// A bend that turns by phi at curvature kappa is brief if the tangents at its ends meet no farther
/// from the bend than the error that is allowed at corners:
///   (1 / cos(phi / 2) - 1) / kappa <= corner error.
/// A bend that is cut by an end of the curve counts as one that lasts.
class Bends {
 public:
  /// @param corner_error  [mm]
  explicit Bends(double corner_error) : corner_error_(corner_error) {}

  /// Finds intervals and bends of a curve. All bends of a NURBS of the program last.
  void find(const path::FittedCurve& curve);

  const std::vector<BendInterval>& intervals() const noexcept { return intervals_; }
  /// The middles of the brief bends, in path order.
  const std::vector<BendPeak>& peaks() const noexcept { return peaks_; }

 private:
  void find_intervals(const path::FittedCurve& curve);
  void divide(const path::FittedCurve& curve, const geometry::CurvatureSample& a,
              const geometry::CurvatureSample& b, int depth);
  void find_brief_bends(double first_curvature, double last_curvature);
  void add_peak(std::size_t first, std::size_t last, double turn);

  double corner_error_;
  std::vector<BendInterval> intervals_;
  std::vector<BendPeak> peaks_;
};

}  // namespace twin::feedrate
