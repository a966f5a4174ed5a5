#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/vec.hpp"

namespace twin::path {

/// Limits of an axis of the machine. In the plane of the corner it has the parts p along x and y, and of
/// a vector q it has p_x q_x + p_y q_y in the one half of a passage and p_x q_x - p_y q_y in the other.
struct CornerAxis {
  Vec2 part = Vec2::Zero();   ///< |p_x|, |p_y| [-]
  double acceleration = 0.0;  ///< largest |d2/dt2|; 0: no limit [mm/s^2]
  double jerk = 0.0;          ///< largest |d3/dt3|; 0: no limit [mm/s^3]
};

/// What a passage through a corner has to keep.
struct CornerDemand {
  double half_turn = 0.0;     ///< half of the change of direction phi, 0 < phi < pi / 2 [rad]
  double feedrate = 0.0;      ///< V, on both legs [mm/s]
  double tolerance = 0.0;     ///< e, largest distance between passage and legs [mm]
  double acceleration = 0.0;  ///< A, largest |d2x/dt2| [mm/s^2]
  double jerk = 0.0;          ///< J, largest |d3x/dt3| [mm/s^3]
  std::array<CornerAxis, 3> axes{};
  double path_jerk = 0.0;  ///< largest |d2v/dt2| of the feedrate v = |dx/dt|; 0: no limit [mm/s^3]

  /// The least of A, or J, of what axes that have a part in the corner have of it, and of the path's:
  /// what a motion in any direction may have.
  double least_acceleration() const noexcept;  ///< [mm/s^2]
  double least_jerk() const noexcept;          ///< [mm/s^3]
};

/// Half of a passage through a corner between two straight legs: a motion in time.
///
///           y                     The corner is at the origin, and y bisects it. The motion begins on
///    \      |      / d            the y axis at t = 0 and ends at t = T on the leg d, which it then
///      \    |    /                follows: at the feedrate V, with no acceleration.
///        \  .--/----.             The other half is its mirror image in space and time:
///         \ | / e                   x(-t) = -x(t),   y(-t) = y(t).
///           o---------- x
///
/// The jerk vector is constant in each of kPieces pieces of equal duration, so that position,
/// velocity and acceleration are continuous. In the whole passage
///   |d3x/dt3| <= J,   |d2x/dt2| <= A,   |dx/dt| <= V,
/// acceleration and jerk of each axis are within its limits, the distance from the legs is at most e on either side of them, and the passage comes as close
/// as e to the corner.
struct HalfCorner {
  static constexpr std::size_t kPieces = 8;

  /// The motion at the begin of a piece, and the jerk in it.
  struct Node {
    Vec2 position = Vec2::Zero();      ///< [mm]
    Vec2 velocity = Vec2::Zero();      ///< [mm/s]
    Vec2 acceleration = Vec2::Zero();  ///< [mm/s^2]
    Vec2 jerk = Vec2::Zero();          ///< [mm/s^3]
  };

  std::array<Node, kPieces> nodes{};
  double duration = 0.0;      ///< T [s]
  double way = 0.0;           ///< distance of its end from the corner [mm]
  double deviation = 0.0;     ///< largest distance between passage and legs [mm]
  double feedrate = 0.0;      ///< V [mm/s]
  double acceleration = 0.0;  ///< largest |d2x/dt2| [mm/s^2]

  /// Time that the whole passage takes longer than the legs would at V without a corner [s].
  double loss() const noexcept { return 2.0 * (duration - way / feedrate); }
};

/// Duration of the half passages that solve_half_corner() looks for first [s]. It depends on
/// neither the turn nor the legs.
double half_corner_duration(const CornerDemand& demand) noexcept;

/// Finds the half passage that comes farthest along its leg, which is the one that loses the least
/// time: for a given duration this is a convex program, with one best solution.
///
/// The program has the jerk of each piece and the motion at t = 0 as unknowns. Position, velocity
/// and acceleration at any time are linear in them; each limit is a disc or a strip, and is kept at
/// the places where it can be exceeded first. It is solved by an interior-point method: Newton's method
/// on the objective with logarithmic barriers, whose weight falls by steps.
///
/// The jerk of the path, d2v/dt2 = t j + a_n^2 / v with t the direction, a_n the normal acceleration and
/// j the jerk, is not convex. Where it is limited, the program is solved again with t and a_n^2 / v of the
/// solution before, until its solution keeps the limit.
///
/// @returns nothing where no passage of up to about 1.4 times half_corner_duration() exists
std::optional<HalfCorner> solve_half_corner(const CornerDemand& demand);

}  // namespace twin::path
