#pragma once

#include <array>

#include "core/vec.hpp"

namespace twin::results {

/// One period of a trajectory, as computed from set points alone.
struct Step {
  double chord = 0.0;  ///< distance of the two set points [mm]
  double arc = 0.0;    ///< arc length of the path between them, best estimate [mm]
  double doubt = 0.0;  ///< bound of the error of `arc` [mm]
  double bend = 0.0;   ///< angle by which the path turns in this period [rad]
};

/// Estimates from set points the arc length that the path covers in each period.
///
/// The chord c joins two set points, but the machine moves along the arc between them. A path of
/// curvature kappa turns by the angle x in the period, and the arc a follows from
///   sin(x / 2) = kappa c / 2,   a = c (x / 2) / sin(x / 2),                          (1)
/// which is exact on a circle. The arc is longer than the chord by only c x^2 / 24. Yet differences
/// of chords in place of arcs would falsify the tangential acceleration by T / 24 d/dt(a_n^2 / v),
/// a tenth of its value at a normal acceleration a_n of 2450 mm/s^2, and the jerk by more.
///
/// The curvature vector at set point i is that of the circle through the points i - 1, i, i + 1,
///   kappa_i = 2 (e_(i-1) x e_i) / |p_(i+1) - p_(i-1)|,   e_i = unit (p_(i+1) - p_i). (2)
/// The mean curvature over the period between points i and i + 1 is that of the polynomial through
/// four of these values,
///   kappa = (-11 kappa_(i-1) + 71 kappa_i + 71 kappa_(i+1) - 11 kappa_(i+2)) / 120.  (3)
/// The weights take into account that kappa_i itself is a mean over two periods. They are exact for
/// a curvature that is a cubic function of s.
///
/// Set points do not determine the arc if the curvature jumps or a corner lies inside the period.
/// The field `doubt` bounds the error. It is the change of a in (1) that the second difference of
/// kappa would cause,
///   dx = c max |kappa_(i+1) - 2 kappa_i + kappa_(i-1)|,
///   u = c (2 x dx + dx^2 + 3 l^2) / 24,                                             (4)
/// where l is the angle by which the path turns more than in the neighbouring periods, as it does
/// at a corner between two set points. A turn of more than kSharp within a period must be a corner.
/// The doubt is then the longest of the chords around the period.
class ArcSteps {
 public:
  static constexpr double kSharp = 0.7;  ///< a larger turn within one period is a corner [rad]
  static constexpr int kDelay = 3;       ///< push(n) completes the period from point n - 3 to n - 2

  /// Starts at rest on the given point [mm].
  void reset(const Vec3& point) noexcept;

  /// Takes the next set point [mm]. Real-time safe.
  /// @returns the period that began kDelay set points ago
  Step push(const Vec3& point) noexcept;

 private:
  /// What is known of one set point: the chord that begins there, and how the path bends there.
  struct Node {
    double chord = 0.0;             // to the next set point [mm]
    double turn = 0.0;              // between the chords before and after [rad]
    Vec3 curvature = Vec3::Zero();  // Eq. 2 [1/mm]
  };

  std::array<Node, 4> nodes_{};    // set points n - 4 to n - 1 once n has been pushed
  Vec3 last_ = Vec3::Zero();       // set point n [mm]
  Vec3 chord_ = Vec3::Zero();      // last_ less the point before [mm]
  Vec3 direction_ = Vec3::Zero();  // of the last chord that had a length
};

}  // namespace twin::results
