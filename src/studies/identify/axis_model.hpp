#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "config/machine_file.hpp"
#include "hal/dac.hpp"
#include "hal/mujoco/encoder.hpp"
#include "hal/mujoco/table_axis.hpp"
#include "motion/servo/axis_servo.hpp"

namespace twin::studies::identify {

/// How long a run holds still before its first set point [s] (runtime::Pace).
inline constexpr double kSettleTime = 0.3;

/// What makes one servo axis: its mechanics and drive, and the loop around them.
struct AxisSetup {
  hal::mujoco::AxisParams axis;
  motion::Gains servo;
  double period = 0.001;       ///< interpolation period T [s]
  double physics_step = 1e-4;  ///< at most; a whole number of steps makes a period [s]
};

/// The setup of one axis of a machine file.
AxisSetup axis_setup(const config::MachineFile& machine, hal::Axis axis);

/// One axis at the instant t_k at which the controller reads its encoder.
struct AxisRow {
  double encoder = 0.0;  ///< what the counts mean [mm]
  double table = 0.0;    ///< true position [mm]
  double volts = 0.0;    ///< drive command of this period, before the converter [V]
};

/// One servo axis of the simulated table with its position loop, without MuJoCo.
///
/// The axes of the table with rigid screws are two slides that move each other not at all, so one
/// axis alone is the whole machine to rounding: converter, axis (delay, drive, friction) and
/// encoder are those of the table, and the mass M = m + J (2 pi / lead)^2 [kg] is integrated as
/// MuJoCo does,
///   v' = v + h F / M,   x' = x + h v'.
/// A period is that of the controller: read (one period of time passes), servo, write.
///
/// Screws that give (xy_table_compliant.xml) and the pen are not modelled.
class AxisModel {
 public:
  /// The slide at rest, the servo off, no time passed. Allocates.
  /// @param start  position of the slide, in the controller's coordinates [mm]
  explicit AxisModel(const AxisSetup& setup, double start = 0.0);

  /// One period of the closed loop. Real-time safe.
  AxisRow follow(const motion::Reference& reference) noexcept;
  /// One period with the position loop replaced by a drive command [V]. Real-time safe.
  AxisRow drive(double volts) noexcept;
  /// Holds a position for kSettleTime, as a run does before its first set point [mm]. Real-time
  /// safe.
  void settle(double position) noexcept;

  /// Velocity of the slide [mm/s].
  double velocity() const noexcept { return velocity_; }
  /// True once the motion is no longer finite or far outside any machine; it then stands still.
  bool has_failed() const noexcept { return has_failed_; }

 private:
  void advance() noexcept;
  void write(double volts) noexcept;

  hal::Dac dac_;
  hal::mujoco::TableAxis axis_;
  hal::mujoco::Encoder encoder_;
  motion::AxisServo servo_;
  double mm_per_count_;
  double rad_per_mm_;        // of the motor [rad/mm]
  double force_per_torque_;  // at the slide [N/(N.m)]
  double rate_per_force_;    // h / M [mm/s/N]
  double step_;              // h [s]
  int steps_;                // physics steps in a period
  std::int64_t steps_done_ = 0;
  double position_;        // of the slide [mm]
  double velocity_ = 0.0;  // [mm/s]
  bool has_failed_ = false;
};

/// A whole run of one axis.
struct AxisRun {
  std::vector<AxisRow> rows;  ///< one for each set point
  bool has_failed = false;    ///< the loop became unstable; the rows stand still from then on
};

/// Runs one axis: kSettleTime at the first set point, then along all of them.
AxisRun simulate(const AxisSetup& setup, std::span<const motion::Reference> set_points);

/// Positions with the velocity and acceleration of their central differences, for set points that
/// were recorded as positions only.
///
///   v_k = (8 (r_{k+1} - r_{k-1}) - (r_{k+2} - r_{k-2})) / 12 T,
///   a_k = (r_{k+1} - 2 r_k + r_{k-1}) / T^2,
/// both exact where the jerk is constant,
/// at rest before the first and after the last.
/// @param positions [mm]  @param period T [s]
std::vector<motion::Reference> differentiate(std::span<const double> positions, double period);

}  // namespace twin::studies::identify
