#pragma once

#include <memory>

#include "core/vec.hpp"
#include "path/corner/half_corner.hpp"

namespace twin::path {

/// Position of a motion in space and its first two derivatives by time.
struct SpaceMotion {
  Vec3 position = Vec3::Zero();      ///< [mm]
  Vec3 velocity = Vec3::Zero();      ///< [mm/s]
  Vec3 acceleration = Vec3::Zero();  ///< [mm/s^2]
};

/// A passage through the corner between two straight legs: a motion in time along a curve that
/// belongs to it, in place of a path and a feedrate.
///
/// It is a HalfCorner and its mirror image, C(t) for -T <= t <= T, put into space by
///   C(t) = corner + x(t / scale) X + y(t / scale) Y.
/// It begins on the one leg and ends on the other, with the feedrate V and no acceleration.
///
/// To whoever plans feedrates it is a part of the path with the length 2 V T. At the feedrate V it
/// takes the time that it was made for. At a constant feedrate x V, x < 1, it is passed on the
/// same curve in the time 2 T / x: velocities are x times as large, accelerations x^2 times, jerks
/// x^3 times. Where the feedrate is to change within it, the feedrate is at most slow() V:
///   acceleration   |C'' v^2 + C' a|               <= A
///   jerk           |C''' v^3 + 3 C'' v a + C' j|  <= J
/// with derivatives by the distance on that scale, |C'| <= 1, |C''| <= A' / V^2, |C'''| <= J / V^3,
/// where A' is the largest acceleration in the passage.
struct CornerMotion {
  Vec3 corner = Vec3::Zero();  ///< [mm]
  Vec3 x = Vec3::UnitX();      ///< X [-]
  Vec3 y = Vec3::UnitY();      ///< Y, towards the inside of the corner [-]
  double scale = 1.0;          ///< of time [-]
  std::shared_ptr<const HalfCorner> half;
  double feedrate = 0.0;      ///< V [mm/s]
  double way = 0.0;           ///< distance of its ends from the corner [mm]
  double deviation = 0.0;     ///< largest distance between it and the legs [mm]
  double acceleration = 0.0;  ///< A, the least of path and axes [mm/s^2]
  double jerk = 0.0;          ///< J, the least of path and axes [mm/s^3]

  double duration() const noexcept { return 2.0 * scale * half->duration; }
  /// The length that it counts for, 2 V T [mm].
  double length() const noexcept { return feedrate * duration(); }
};

/// What a feedrate that changes within a passage keeps.
struct SlowPassage {
  double feedrate = 0.0;      ///< [mm/s]
  double acceleration = 0.0;  ///< [mm/s^2]
  double jerk = 0.0;          ///< [mm/s^3]
};

/// The limits within which a motion may do as it likes in a passage.
SlowPassage slow_passage(const CornerMotion& passage) noexcept;

/// The motion at a distance s from the begin, where the feedrate is v and its derivative a.
/// @note Real-time safe.
SpaceMotion motion_in(const CornerMotion& passage, double s, double v, double a) noexcept;

}  // namespace twin::path
