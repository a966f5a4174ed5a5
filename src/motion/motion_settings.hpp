#pragma once

#include <cstdint>

/// What the machine file says of the real-time cycle: interpolator, servo loop and monitors.
namespace twin::motion {

/// How the parameter of a curve goes on from one period to the next.
enum class ParameterUpdate : std::uint8_t {
  kTaylor1,      ///< first-order Taylor step
  kTaylor2,      ///< second-order Taylor step, as printed [WY09, Eq. 23]
  kRungeKutta4,  ///< classical Runge-Kutta step of du/dt = V(t) / |C'(u)|
  kCorrected,    ///< the Taylor step predicts, the arc length corrects: exact
};

/// What happens in the period in which a curve ends.
enum class CurveEnd : std::uint8_t {
  kCarry,  ///< the remainder of the period is travelled on the next segment
  kLand,   ///< the set point lands on the curve's end, and the remainder is lost, as steps 1 to 4
           ///< of [WY09, Section 3.3] have it
};

/// Variants of the interpolator.
struct InterpolatorSettings {
  ParameterUpdate update = ParameterUpdate::kCorrected;
  CurveEnd curve_end = CurveEnd::kCarry;
};

inline constexpr int kMostVelocityPeriods = 8;  ///< of Gains::kv_periods

/// Gains of one axis of the position loop that runs (not the planning gains).
///
/// Command velocity u = Kp e + Kd de/dt + Kf v + Ka a - Kv w with e = set point less measured, v and
/// a of the set point and w the measured velocity; the drive command is u over the V-REF scale, plus
/// a trim. A drive in torque mode has no loop of the speed, so Kv makes one here.
struct Gains {
  double kp = 150.0;           ///< position gain [1/s]
  double kd = 0.0;             ///< derivative gain [-]
  double kf = 1.0;             ///< velocity feedforward [-]
  double ka = 0.0;             ///< acceleration feedforward [s]
  double trim_V = 0.0;         ///< added to the drive command against the drive's offset [V]
  double kv = 0.0;             ///< velocity feedback [-]
  int kv_periods = 1;          ///< over which w is the mean measured velocity
  double command_delay = 0.0;  ///< how late the set point reaches the loop [s]
};

/// Limits of the monitors, the same for both axes; section [safety] of the machine file.
struct SafetySettings {
  double tracking_error = 0.5;                ///< limit at rest [mm]
  double tracking_error_per_feedrate = 0.02;  ///< added per feedrate [mm/(mm/s) = s]
  double tracking_filter_time = 0.01;         ///< how long it may be exceeded [s]
  double runaway = 0.1;                       ///< tracking error that a wrong sign may make [mm]
  double runaway_per_feedrate = 0.002;        ///< added per feedrate [mm/(mm/s) = s]
  double frozen_encoder = 0.3;      ///< way of the command that must change the counts [mm]
  double count_step_ratio = 3.0;    ///< fastest plausible counts over the largest feedrate [-]
  double saturation_time = 0.05;    ///< how long a drive command may be cut to +-10 V [s]
  double heartbeat_timeout = 0.02;  ///< longest silence before the guard acts [s]
  double ready_timeout = 3.0;       ///< from servo on to servo ready at the latest [s]
};

}  // namespace twin::motion
