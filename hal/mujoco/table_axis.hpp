#pragma once

#include "hal/mujoco/change.hpp"
#include "hal/mujoco/delay_line.hpp"
#include "hal/mujoco/drive.hpp"
#include "hal/mujoco/friction.hpp"
#include "hal/mujoco/table_params.hpp"

namespace twin::hal::mujoco {

/// Where one axis is at the start of a physics step.
struct AxisMotion {
  double position = 0.0;     ///< of the slide, 0 in the middle of its travel [mm]
  double velocity = 0.0;     ///< of the slide [mm/s]
  double motor_speed = 0.0;  ///< [rad/s]
};

/// What acts on it during the step.
struct AxisForces {
  double torque = 0.0;  ///< of the motor [N.m]
  double slide = 0.0;  ///< friction, weight, ripple and end stops, along the positive direction [N]
};

/// One servo axis between its terminals and its slide: drive, friction, switches, end stops.
///
/// MuJoCo moves the masses; everything else of the axis is here, in mm, N and V.
class TableAxis {
 public:
  /// @param step physics step [s]. Allocates.
  TableAxis(const AxisParams& params, double step);

  /// V-REF at the terminals from now on [V], finite. Real-time safe.
  void command(double volts, bool servo_on) noexcept;
  /// One physics step. Real-time safe. @param time since the first step [s]
  AxisForces step(const AxisMotion& motion, double time) noexcept;
  /// Makes a motion that goes on the past: drive ready, friction sliding. Real-time safe.
  /// @param volts  V-REF [V]  @param torque  of the motor [N.m]
  void begin_moving(const AxisMotion& motion, double volts, double torque) noexcept;
  /// Servo off. Alarms stay until reset_drive(). Real-time safe.
  void switch_off() noexcept { command(0.0, false); }
  /// Clears an alarm and the states of the drive. Real-time safe.
  void reset_drive() noexcept;
  /// Lets drive and friction differ from their parameters from the next step on; stiffness, play,
  /// lost edges and mass are not here. Real-time safe.
  void set_condition(const AxisCondition& condition) noexcept {
    condition_ = condition;
    drive_.set_loop_gain(condition.loop_gain);
  }
  /// Makes the drive give alarm. Real-time safe.
  void trip() noexcept { drive_.trip(); }
  /// Opens limit switches wherever the slide is, or leaves them to it again. Real-time safe.
  void force_limits(bool positive, bool negative) noexcept {
    is_forced_positive_ = positive;
    is_forced_negative_ = negative;
  }

  const Drive& drive() const noexcept { return drive_; }
  double torque() const noexcept { return torque_; }  ///< of the motor, in the last step [N.m]
  double friction() const noexcept {
    return resistance_;
  }  ///< against motion, in the last step [N]
  bool is_limit_positive(double position) const noexcept {
    return is_forced_positive_ || position >= travel_;
  }
  bool is_limit_negative(double position) const noexcept {
    return is_forced_negative_ || position <= -travel_;
  }

 private:
  double end_stop(const AxisMotion& motion) const noexcept;
  double load(double position) const noexcept;

  double travel_;  // limit switches at +-travel_ [mm]
  DelayLine delay_;
  Drive drive_;
  Friction friction_;
  LoadParams load_;
  AxisCondition condition_;
  double ripple_per_mm_;     // angle of the ripple per travel [rad/mm]
  double volts_ = 0.0;       // at the terminals [V]
  double torque_ = 0.0;      // of the motor in the last step [N.m]
  double resistance_ = 0.0;  // friction in the last step [N]
  bool servo_on_ = false;
  bool is_forced_positive_ = false;
  bool is_forced_negative_ = false;
};

}  // namespace twin::hal::mujoco
