#pragma once

#include <span>
#include <vector>

#include "config/machine_file.hpp"
#include "hal/dac.hpp"
#include "hal/mujoco/encoder.hpp"
#include "hal/mujoco/table_axis.hpp"
#include "motion/servo/axis_servo.hpp"
#include "studies/identify/sine_steps.hpp"

namespace twin::studies::identify {

/// Time for which a run holds the machine at rest before its first set point [s]; the same as
/// runtime::MotionOptions::rest_before.
inline constexpr double kSettleTime = 0.3;

/// Parameters of one servo axis.
struct AxisSetup {
  hal::mujoco::AxisParams axis;  ///< mechanics, drive, converter and encoder
  motion::Gains servo;           ///< gains of the position loop
  double period = 0.001;         ///< interpolation period T [s]
  double physics_step = 1e-4;    ///< longest integration step; it is shortened to divide T [s]
  bool has_screw = false;        ///< the screw gives and may have play
};

/// The setup of one axis of a machine file.
AxisSetup axis_setup(const config::MachineFile& machine, hal::Axis axis);

/// State of one axis at the instant at which the controller reads its encoder.
struct AxisRow {
  double encoder = 0.0;   ///< position by the encoder counts [mm]
  double table = 0.0;     ///< true position of the slide [mm]
  double feedback = 0.0;  ///< position that the encoder rounds, late by its delay [mm]
  double volts = 0.0;     ///< drive command of this period, before the converter [V]
  double force = 0.0;     ///< of the motor at the slide, in the last physics step before it [N]
};

/// A motion that goes on at the begin of a record.
struct BeginOfMotion {
  motion::Reference command;  ///< set point of the first row
  double position = 0.0;      ///< measured there [mm]
  double velocity = 0.0;      ///< [mm/s]
  double acceleration = 0.0;  ///< [mm/s^2]
  double volts = 0.0;         ///< drive command there [V]; not a number: that of steady motion
};

/// Simulates one servo axis of the table with its position loop, without MuJoCo.
///
///   set point -> AxisServo -> converter -> drive -> torque, friction -> slide -> encoder
///                    ^                                                              |
///                    '------------------------ position ----------------------------'
///
/// The two slides of the table do not act on each other. So each axis can be simulated alone, with
/// the same result as the whole table up to rounding. Converter, drive, friction and encoder are the
/// classes that the table uses. The mass M = m + J (2 pi / lead)^2 [kg] is integrated over the
/// physics step h as in MuJoCo,
///   v' = v + h F / M,   x' = x + h v'.
/// A screw that gives ties two such masses, rotor and slide, by hal::mujoco::screw_force().
/// Each period has the order of the controller: read (one period of time passes), servo, write.
///
/// The pen is not modelled.
class AxisModel {
 public:
  /// Starts with the slide at rest and the servo off. Allocates.
  /// @param start  position of the slide, in the coordinates of the controller [mm]
  explicit AxisModel(const AxisSetup& setup, double start = 0.0);

  /// Simulates one period of the closed loop. Real-time safe.
  AxisRow follow(const motion::Reference& reference) noexcept;
  /// Simulates one period in open loop, with a given drive command. Real-time safe.
  /// @param volts  drive command [V]
  AxisRow drive(double volts) noexcept;
  /// Holds a position in closed loop for kSettleTime, as a run does before its first set point.
  /// Real-time safe.
  /// @param position  [mm]
  void settle(double position) noexcept;

  /// Begins in motion, one period before the first row: drive and friction are as in steady motion
  /// with the velocity and acceleration given. Real-time safe.
  void begin_moving(const BeginOfMotion& begin) noexcept;

  /// Velocity of the slide [mm/s].
  double velocity() const noexcept { return velocity_; }
  /// True once the simulated motion is not finite or far outside any machine; the slide then stands
  /// still.
  bool has_failed() const noexcept { return has_failed_; }

 private:
  void advance() noexcept;
  void step_rigid() noexcept;
  void step_with_screw() noexcept;
  double measured_place() const noexcept;
  void write(double volts) noexcept;
  AxisRow row() const noexcept;

  hal::mujoco::AxisParams params_;
  hal::Dac dac_;
  hal::mujoco::TableAxis axis_;  // without hum
  SineSteps hum_;                // on V-REF [V]
  hal::mujoco::Encoder encoder_;
  motion::AxisServo servo_;
  double mm_per_count_;
  double rad_per_mm_;                // of the motor [rad/mm]
  double force_per_torque_;          // at the slide [N/(N.m)]
  double rate_per_force_;            // h / M, change of velocity in a step per force [mm/s/N]
  double step_;                      // physics step h [s]
  int steps_;                        // physics steps in a period
  double period_;                    // [s]
  double force_ = 0.0;               // of the motor at the slide [N]
  hal::mujoco::DelayLine feedback_;  // of the encoder
  double reported_;                  // position behind it [mm]
  double position_;                  // of the slide [mm]
  double velocity_ = 0.0;            // [mm/s]
  bool has_screw_;
  double slide_rate_;            // h / m, of a slide behind a screw that gives [mm/s/N]
  double motor_rate_;            // the same of its rotor [mm/s/N]
  double motor_position_;        // as travel; with such a screw only [mm]
  double motor_velocity_ = 0.0;  // [mm/s]
  bool has_failed_ = false;
};

/// Result of simulate().
struct AxisRun {
  std::vector<AxisRow> rows;  ///< one row for each set point
  bool has_failed = false;    ///< the loop became unstable; later rows repeat the last position
};

/// Simulates a run of one axis in closed loop: holds the first set point for kSettleTime, then
/// follows all set points.
AxisRun simulate(const AxisSetup& setup, std::span<const motion::Reference> set_points);

/// Simulates a run of one axis in closed loop that begins in motion.
AxisRun simulate_moving(const AxisSetup& setup, std::span<const motion::Reference> set_points,
                        const BeginOfMotion& begin);

/// Adds velocity and acceleration to set points that were recorded as positions only.
///
/// Both are central differences of the positions r_k,
///   v_k = (8 (r_{k+1} - r_{k-1}) - (r_{k+2} - r_{k-2})) / 12 T,
///   a_k = (r_{k+1} - 2 r_k + r_{k-1}) / T^2,
/// which are exact where the jerk is constant. Before the first position and after the last one the
/// axis is taken to be at rest.
///
/// @param positions  r_k [mm]
/// @param period     T [s]
std::vector<motion::Reference> differentiate(std::span<const double> positions, double period);

}  // namespace twin::studies::identify
