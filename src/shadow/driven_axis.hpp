#pragma once

#include <span>

#include "hal/dac.hpp"
#include "hal/mujoco/change.hpp"
#include "hal/mujoco/delay_line.hpp"
#include "hal/mujoco/table_axis.hpp"
#include "hal/mujoco/table_params.hpp"

namespace twin::shadow {

/// How the screw of a model passes the motor's force on.
enum class ScrewModel {
  kRigid,  ///< motor and slide are one mass
  kGives,  ///< spring, damper and perhaps play between two masses
};

/// One axis of the table, driven by the drive commands of another one: its converter, drive,
/// friction and masses, without a position loop.
///
/// The drive's own velocity loop holds the speed near the command, so the model stays near the
/// machine as long as the machine is like it, and drifts away by what differs. Friction, drive and
/// screw are the functions of the simulated table. End stops and limit switches are left out; what
/// depends on the place sees the measured one, so a drift does not matter there.
class DrivenAxis {
 public:
  /// @param period        time from command to command [s]
  /// @param physics_step  longest integration step [s]. Allocates.
  DrivenAxis(const hal::mujoco::AxisParams& params, double period, double physics_step,
             ScrewModel screw, const hal::mujoco::AxisCondition& condition);

  /// Begins at a place with a drive command, in steady motion. Real-time safe.
  void begin(double position, double volts) noexcept;
  /// Lets one period pass with the last command. Real-time safe.
  /// @param place  measured [mm]
  /// @param hum    added to the command, physics step by physics step [V]; or empty
  void advance(double place, std::span<const double> hum = {}) noexcept;
  /// Takes the drive command of this period [V]. Real-time safe.
  void command(double volts) noexcept;

  double position() const noexcept { return reported_; }  ///< as the encoder reports it [mm]
  /// Position of the slide [mm].
  double slide() const noexcept {
    return screw_ == ScrewModel::kRigid ? place_of_motor_ : place_of_slide_;
  }
  double velocity() const noexcept { return motor_velocity_; }  ///< of the motor [mm/s]
  /// True once it is not finite any more.
  bool has_failed() const noexcept;

  /// Whether a screw that gives can be integrated with the steps of a machine.
  static bool can_give(const hal::mujoco::AxisParams& params, double period,
                       double physics_step) noexcept;

 private:
  void step_rigid(double place) noexcept;
  void step_with_screw(double place) noexcept;

  hal::mujoco::AxisParams params_;
  hal::mujoco::AxisCondition condition_;
  ScrewModel screw_;
  hal::Dac dac_;
  int steps_;    // in a period
  double step_;  // [s]
  hal::mujoco::TableAxis axis_;
  hal::mujoco::DelayLine feedback_;  // of the encoder
  double rad_per_mm_;                // of the motor
  double force_per_torque_;          // at the slide [N/(N.m)]
  double motor_rate_;                // change of velocity in a step per force [mm/s/N]
  double slide_rate_;                // the same of the slide; rigid: of both
  double place_of_motor_ = 0.0;      // [mm]
  double place_of_slide_ = 0.0;      // [mm]
  double motor_velocity_ = 0.0;      // [mm/s]
  double slide_velocity_ = 0.0;      // [mm/s]
  double reported_ = 0.0;            // [mm]
  double volts_ = 0.0;               // behind the converter [V]
};

}  // namespace twin::shadow
