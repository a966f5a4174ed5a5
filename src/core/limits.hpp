#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/vec.hpp"

namespace twin {

/// Which jerk Limits::jerk bounds: limits.jerk_of of the machine file.
enum class JerkOf : std::uint8_t {
  kPath,    ///< d2v/dt2 of the feedrate along the path [WY09]
  kVector,  ///< |d3x/dt3| of the position, which is what a machine feels
};

/// Names of the jerks, in the order of JerkOf.
inline constexpr std::array<std::string_view, 2> kJerkOfNames{"path", "vector"};

/// What the machine may be asked to do along its path.
struct Limits {
  double feedrate = 200.0;        ///< largest feedrate the machine accepts [mm/s]
  double rapid_feedrate = 100.0;  ///< feedrate of G00 [mm/s]
  double acceleration = 2450.0;   ///< A_max, tangential and normal, each [mm/s^2]
  double jerk = 50000.0;          ///< J_max [mm/s^3]
  JerkOf jerk_of = JerkOf::kPath;
  Vec3 axis_feedrate = Vec3::Zero();       ///< of each axis; 0: no limit of its own [mm/s]
  Vec3 axis_acceleration = Vec3::Zero();   ///< of each axis; 0: no limit of its own [mm/s^2]
  Vec3 axis_jerk = Vec3::Zero();           ///< of each axis; 0: no limit of its own [mm/s^3]
  Vec3 travel_min{-200.0, -200.0, -60.0};  ///< lower ends of travel (x, y, z) [mm]
  Vec3 travel_max{200.0, 200.0, 60.0};     ///< upper ends of travel (x, y, z) [mm]
};

/// What limits the feedrate on arcs and curves; feedrate/limits/feedrate_rules.hpp says how each does.
enum class FeedrateRule : std::uint8_t {
  kAuto,          ///< the servo model; constant on Bezier pieces
  kConstant,      ///< the programmed feedrate everywhere
  kChordError,    ///< the chord of a period stays within the chord tolerance
  kServoModel,    ///< the contouring error of the servo model stays within its tolerance
  kContactSpeed,  ///< the tool's point of contact moves at the programmed feedrate
};

/// Side of the workpiece's surface on which the tool is, seen along the path: G41, G42.
enum class ToolSide : std::uint8_t { kLeft, kRight };

/// How the feedrate changes from one value to another; feedrate/profile/ramps.cpp says how each does.
enum class AccelerationProfile : std::uint8_t {
  kTrapezoidal,  ///< fastest within A_max and J_max
  kSCurve,       ///< without constant acceleration
  kFir,          ///< constant acceleration, then a moving average
};

/// The first-order servo model that the planner believes in (Eqs. 1, 4, 16 of the paper).
///
/// These are the planning gains; the loop that runs has servo gains of its own (motion::Gains).
/// With it go the rules by which the feedrate is planned.
struct PlanningModel {
  double kp = 282.555;            ///< position gain Kp [1/s]
  double kf = 0.1;                ///< velocity feedforward gain Kf, 0 <= Kf < 1 [-]
  double circular_error = 0.005;  ///< circular contouring error eps_ss of Eq. 4 [mm]
  double corner_error = 0.01;     ///< corner error eps_max of Eqs. 1, 16 [mm]
  double critical_feedrate =
      50.0;  ///< V of Eq. 2 with planner = certified; the paper's planner has
             ///< the programmed feedrate there [mm/s]
  FeedrateRule feedrate_rule = FeedrateRule::kAuto;
  double tool_radius = 0.0;              ///< for kContactSpeed [mm]
  ToolSide tool_side = ToolSide::kLeft;  ///< for kContactSpeed
  AccelerationProfile acceleration_profile = AccelerationProfile::kTrapezoidal;
};

}  // namespace twin
