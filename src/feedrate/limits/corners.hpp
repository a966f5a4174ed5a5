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
/// @param turn  change of direction pi - theta, 0 <= turn <= pi [rad]
/// @returns [mm/s]; infinity for a straight passage
double corner_model_feedrate(double turn, double corner_error, const PlanningModel& model) noexcept;

/// Feedrate at which the velocity vector changes by A T within the period that holds the corner.
///
/// The corner changes it by 2 v sin(turn / 2), the bend beside it, of curvature kappa, by up to
/// kappa v^2 T:
///   kappa T v^2 + 2 sin(turn / 2) v = A T.
///
/// @param turn       change of direction at the corner [rad]
/// @param curvature  larger curvature of the path on either side [1/mm]
/// @param period     interpolation period T [s]
double corner_acceleration_feedrate(double turn, double curvature, double acceleration,
                                    double period) noexcept;

/// Feedrate at which a corner between two set points does not look like jerk.
///
/// The chord across the corner is shorter than the way by up to v T turn^2 / 8, depending on where
/// in the period the corner falls. A single corner can be told from a change of feedrate; one of
/// several in a few periods, or one beside a bend, cannot. For those the third difference of the
/// set points that the corner itself makes, up to four times that over T^3, has to stay small:
///   v turn^2 / (2 T^2) <= kRipple J,   with kRipple = 0.1.
///
/// @param jerk  J_max [mm/s^3]
/// @returns [mm/s]; infinity for no turn
double corner_ripple_feedrate(double turn, double jerk, double period) noexcept;

/// A corner that turns by more than this stands out of any bend, even where the two set points
/// beside it share its turn [rad]. A larger angle slows sharp corners beside bends for nothing; a
/// smaller one lets corners pass that the set points show as jerk.
inline constexpr double kSharpTurn = 1.4;

/// Periods around a corner in which another turn hides it: the three that a third difference of set
/// points spans, and half of one for where in its period the corner falls. Twice as many would slow
/// corners that no difference mixes up, and keep more of the path open.
inline constexpr double kHidingPeriods = 3.5;

/// Another turn hides a corner if it is at least this share of the corner's own. Twice as much lets
/// more corners pass as jerk, half as much slows more of them.
inline constexpr double kHidingShare = 0.125;

/// A corner may lower the limits of those before it up to this distance [mm].
/// @param feedrate  the largest one that the machine accepts [mm/s]
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

  /// Appends the limit of the place between two segments, if it has one, and lowers those of the
  /// corners just before it.
  ///
  /// @param s      the place [mm]
  /// @param zones  all zones before it, measured from the same start
  void append(const path::Segment& before, const path::Segment& after, double s,
              std::vector<LimitZone>& zones);

  /// Says that the first zones are gone and that places are measured from a new start.
  /// @param distance  of the new start from the old [mm]
  void forget(double distance, std::size_t zones);

 private:
  struct Turn {
    double s;          // place of the corner [mm]
    double angle;      // [rad]
    std::size_t zone;  // its limit
  };

  void limit_cluster(double turn, double s, std::vector<LimitZone>& zones);

  Limits limits_;
  PlanningModel model_;
  RampLimits ramp_;
  double period_;
  std::vector<Turn> turns_;  // corners that later ones may still limit
};

}  // namespace twin::feedrate
