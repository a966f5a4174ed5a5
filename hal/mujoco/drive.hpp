#pragma once

#include "hal/mujoco/speed_feedback.hpp"
#include "hal/mujoco/table_params.hpp"

namespace twin::hal::mujoco {

/// What a drive is told by its terminals, besides V-REF.
struct DriveSignals {
  bool servo_on = false;
  bool limit_positive = false;  ///< P-OT: no positive speed any more
  bool limit_negative = false;  ///< N-OT: no negative speed any more
};

/// Servo drive with its motor's current loop, in speed mode or in torque mode.
///
///   V-REF -> (+ offset + hum) -> input filter -> x scale -> velocity PI -> torque limit
///         -> current loop -> torque
///
/// The velocity loop is referred to the total inertia J, so that its gain f is a bandwidth. With
/// K = 2 pi f,
///   tau* = J K (e + (1/Ti) int e dt),   e = w_ref - w                               [N.m]
/// and on the bare inertia, without limit and lag, w / w_ref = K (s + 1/Ti) / (s^2 + K s + K / Ti).
/// Ti = 0 leaves the integral out. The loop sees w by SpeedFeedback and works at its samples.
///
/// In torque mode the filtered V-REF times a scale is tau*, and there is no velocity loop; a limit
/// switch takes the torque towards it away.
///
/// Anti-windup: the integral stands still while the torque is at its limit and the error would
/// drive it further. The current loop is a first-order lag, taken exactly over a step. The motor
/// gives no torque while the servo is off, until ready_delay after it was switched on, and after an
/// alarm.
class Drive {
 public:
  /// @param inertia total inertia J at the motor [kg m^2]  @param step physics step [s]
  /// @param torque_per_volt  of torque mode, signed [N.m/V]
  Drive(const DriveParams& drive, const MotorParams& motor, double inertia, double step,
        double torque_per_volt = 0.0);

  /// Advances by one step and returns the motor's torque [N.m]. Real-time safe.
  /// @param volts  V-REF at the terminals [V]   @param speed  motor speed [rad/s]   @param time [s]
  double step(double volts, double speed, double time, const DriveSignals& signals) noexcept;
  /// Makes it ready, with the past of a motion that goes on. Real-time safe.
  /// @param volts  V-REF of the past [V]  @param speed  [rad/s]  @param torque  [N.m]
  void begin_moving(double volts, double speed, double torque) noexcept;
  /// Torque-free, filters empty, alarm cleared. Real-time safe.
  void reset() noexcept;
  /// Multiplies the gain of the velocity loop by a factor > 0; its torque does not jump. Real-time
  /// safe.
  void set_loop_gain(double factor) noexcept;
  /// Gives alarm. Real-time safe.
  void trip() noexcept { has_alarm_ = true; }

  bool is_ready() const noexcept { return is_ready_; }
  bool has_alarm() const noexcept { return has_alarm_; }
  double current() const noexcept { return current_; }  ///< motor current [A]

 private:
  void filter_reference(double volts, double time) noexcept;
  double speed_reference(const DriveSignals& signals) const noexcept;
  double wanted_torque(double speed, const DriveSignals& signals) noexcept;
  double velocity_loop(double error) noexcept;
  double limited(double wanted) noexcept;
  void watch_overload(bool is_limited) noexcept;

  DriveParams drive_;
  MotorParams motor_;
  double full_gain_;        // J K [N.m s/rad]
  double gain_;             // the same times the factor of set_loop_gain()
  double step_;             // [s]
  double torque_per_volt_;  // of torque mode [N.m/V]
  SpeedFeedback feedback_;
  double input_share_;         // 1 - exp(-h / input_lag), 1 without lag
  double current_share_;       // the same of the current loop
  double filtered_ = 0.0;      // V-REF behind its filter [V]
  double integral_ = 0.0;      // (1/Ti) int e dt [rad/s]
  double torque_ = 0.0;        // that the velocity loop wants since its last sample [N.m]
  double current_ = 0.0;       // [A]
  double time_on_ = 0.0;       // since /S-ON [s]
  double time_limited_ = 0.0;  // at the torque limit without a break [s]
  bool is_ready_ = false;
  bool has_alarm_ = false;
};

}  // namespace twin::hal::mujoco
