#pragma once

#include <cstddef>
#include <vector>

#include "core/limits.hpp"
#include "feedrate/limits/zones.hpp"
#include "feedrate/profile/ramps.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// Corner feedrate of the servo model: V = Kp/(1 - Kf) eps_max / cos(theta / 2).
///   [WY09, Eq. 16]
///
/// theta is the angle between the two segments, pi where they are in line.
///
/// @param turn          change of direction pi - theta, 0 <= turn <= pi [rad]
/// @param corner_error  contour error eps_max that is allowed at the corner [mm]
/// @returns [mm/s]; infinity where the direction does not change
double corner_model_feedrate(double turn, double corner_error, const PlanningModel& model) noexcept;

/// Feedrate at which the velocity vector changes by A T within the period that contains the corner.
///
/// The corner changes the velocity vector by 2 v sin(turn / 2). A bend of curvature kappa beside
/// the corner changes it by up to kappa v^2 T more. So v is the positive root of
///   kappa T v^2 + 2 sin(turn / 2) v = A T.
///
/// @param turn          change of direction at the corner [rad]
/// @param curvature     curvature kappa, the larger one of both sides of the corner [1/mm]
/// @param acceleration  A [mm/s^2]
/// @param period        interpolation period T [s]
/// @returns [mm/s]
double corner_acceleration_feedrate(double turn, double curvature, double acceleration,
                                    double period) noexcept;

/// Feedrate up to which a corner between two set points is not mistaken for jerk.
///
/// The chord between the set points before and after a corner is shorter than the path by up to
/// d = v T turn^2 / 8, depending on where in the period the corner falls. Whoever looks at the set
/// points alone can recognise a single corner. He cannot if several corners fall into a few periods
/// or if a bend lies beside the corner: then d appears in the third difference of the set points as
/// a jerk of up to 4 d / T^3, which has to stay small:
///   v turn^2 / (2 T^2) <= kRipple J,   with kRipple = 0.1.
///
/// @param turn    change of direction at the corner [rad]
/// @param jerk    J_max [mm/s^3]
/// @param period  interpolation period T [s]
/// @returns [mm/s]; infinity where turn is 0
double corner_ripple_feedrate(double turn, double jerk, double period) noexcept;

/// Limits of a place where the first or second derivative of the path jumps, for limits of single
/// axes.
///
/// At feedrate v a jump D of dC/ds changes the velocity of an axis by D v, and a jump K of d2C/ds2
/// changes its acceleration by K v^2, both within one period. So an axis keeps
///   D v <= A T,   D v <= J T^2,   K v^2 <= J T,
/// each with a quarter of its limits. Beside a jump of d2C/ds2 the tangential jerk is limited, too.
///
/// @param period  interpolation period T [s]
/// @returns a zone without place; its limit is infinite where nothing limits the feedrate
LimitZone axis_jump_limit(const path::PathPoint& before, const path::PathPoint& after,
                          const Limits& limits, double period) noexcept;

/// A corner that turns by more than this can be recognised beside any bend, even if its turn is
/// spread over two set points [rad]. A larger angle slows down sharp corners beside bends for
/// nothing; a smaller one leaves corners at full feedrate that the set points show as jerk.
inline constexpr double kSharpTurn = 1.4;

/// A turn within so many periods of a corner hides the corner. A third difference of set points
/// spans three periods, and half a period is added because the corner may be anywhere within its
/// own. Twice as many would slow down corners that no difference contains together, and would keep
/// more of the path from being final.
inline constexpr double kHidingPeriods = 3.5;

/// Another turn hides a corner if its angle is at least this share of the corner's own [-]. Twice
/// as much leaves more corners that look like jerk; half as much slows down more corners.
inline constexpr double kHidingShare = 0.125;

/// Distance over which a corner may lower the limits of the corners before it [mm].
/// @param feedrate  largest feedrate of the machine [mm/s]
/// @param period    interpolation period [s]
constexpr double corner_reach(double feedrate, double period) noexcept {
  return kHidingPeriods * feedrate * period;
}

/// Feedrate limits of the places where segments meet: stops, single corners, and corners so close
/// together that one period, or a few of them, hold several.
class JunctionLimits {
 public:
  /// @param period  interpolation period [s]
  JunctionLimits(const Limits& limits, const PlanningModel& model, double period);

  /// Appends the limit of the junction between two segments, if there is one, and lowers the limits
  /// of corners just before the junction that are hidden by it.
  ///
  /// @param s      distance of the junction along the path [mm]
  /// @param zones  all zones before the junction, with distances from the same origin
  void append(const path::Segment& before, const path::Segment& after, double s,
              std::vector<LimitZone>& zones);

  /// Follows a shift of the origin: the caller has removed the first zones, and from now on
  /// measures distances from a later place of the path.
  /// @param distance  distance of the new origin from the old one [mm]
  /// @param zones     number of zones that were removed
  void forget(double distance, std::size_t zones);

 private:
  struct Turn {
    double s;          // distance of the corner along the path [mm]
    double angle;      // change of direction [rad]
    std::size_t zone;  // index of the zone that has the corner's limit
  };

  void limit_cluster(double turn, double s, std::vector<LimitZone>& zones);

  Limits limits_;
  PlanningModel model_;
  RampLimits ramp_;
  double period_;
  double turn_back_;         // feedrate of a turn back that other corners hide [mm/s]
  std::vector<Turn> turns_;  // corners that later ones may still limit
};

}  // namespace twin::feedrate
