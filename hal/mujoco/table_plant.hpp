#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "hal/mujoco/change.hpp"
#include "hal/mujoco/delay_line.hpp"
#include "hal/mujoco/encoder.hpp"
#include "hal/mujoco/table_axis.hpp"
#include "hal/mujoco/table_params.hpp"

namespace twin::hal::mujoco {

class TablePhysics;

/// Simulates the servo XY table from the V-REF terminals of its drives to the shafts of its
/// encoders. D/A converters and counters are not a part of it.
///
/// MuJoCo integrates the motion of the masses (semi-implicit Euler, no contacts, no constraints).
/// Drive and friction act on the masses as generalised forces, which are computed anew before every
/// physics step. Nothing depends on the wall clock or on other plants in the process: the same
/// calls give the same bytes.
class TablePlant {
 public:
  /// Makes a table at rest in the middle of its travel, with 0 V and servo off.
  /// @param period  time that advance() lets pass, > 0 [s]
  /// @returns kMachine error for a parameter out of range, kModel error for a model that fails
  static Expected<std::unique_ptr<TablePlant>> open(const TableParams& params, double period);
  ~TablePlant();
  TablePlant(const TablePlant&) = delete;
  TablePlant& operator=(const TablePlant&) = delete;

  /// Sets the signals at the terminals of a drive. Real-time safe. @param volts  V-REF, finite [V]
  void command(std::size_t axis, double volts, bool servo_on) noexcept;
  /// Resets a drive: no alarm, filters and integrals empty, servo off. Real-time safe.
  void reset_drive(std::size_t axis) noexcept;
  /// Makes a drive give an alarm. Real-time safe.
  void trip(std::size_t axis) noexcept;
  /// True opens a limit switch wherever the slide is; false lets the slide work it again. Real-time
  /// safe.
  void force_limits(std::size_t axis, bool positive, bool negative) noexcept;
  /// Sets the position that the pen slide moves to [mm]. Real-time safe.
  void set_pen_reference(double z) noexcept { pen_reference_ = z; }
  /// Sets an external force on a slide, positive along its positive direction, which acts until it
  /// is changed [N]. Real-time safe.
  void set_external_force(std::size_t axis, double force) noexcept {
    external_force_[axis] = force;
  }

  /// Lets one period pass. Real-time safe.
  /// @returns false if the simulation has failed; it then stays as it is, and last_error() says why
  bool advance() noexcept;

  double position(std::size_t axis) const noexcept;  ///< position of the slide [mm]
  double velocity(std::size_t axis) const noexcept;  ///< velocity of the slide [mm/s]
  /// Motor angle as travel, as late as the encoder reports it [mm].
  double encoder_position(std::size_t axis) const noexcept;
  double pen_position() const noexcept;  ///< position of the pen slide [mm]
  /// Torque of the motor in the last physics step [N.m].
  double torque(std::size_t axis) const noexcept { return axes_[axis].torque(); }
  /// Friction of the slide in the last physics step, positive against positive motion [N].
  double friction(std::size_t axis) const noexcept { return axes_[axis].friction(); }
  bool is_ready(std::size_t axis) const noexcept { return axes_[axis].drive().is_ready(); }
  bool has_alarm(std::size_t axis) const noexcept { return axes_[axis].drive().has_alarm(); }
  bool is_limit_positive(std::size_t axis) const noexcept;
  bool is_limit_negative(std::size_t axis) const noexcept;
  /// Simulated time since open() [s].
  double time() const noexcept { return static_cast<double>(steps_done_) * step_; }
  /// Why advance() returned false; empty when it did not. Not real-time safe.
  std::string last_error() const;

 private:
  TablePlant(std::unique_ptr<TablePhysics> physics, const TableParams& params, double step,
             int steps);
  void step();
  /// What has changed of an axis, where something changes at all.
  struct Changing {
    AxisCondition now;
    double ready_at = -1.0;      // when its drive first became ready; negative: not yet [s]
    Encoder edges;               // counts of the shaft, before any is lost
    std::int64_t counts = 0;     // of it in the last step
    double passed = 0.0;         // edges since the last one that was lost, times the lost share
    double lost = 0.0;           // edges that were lost, signed, as travel [mm]
    double mm_per_count = 0.01;  // signed [mm]
  };
  void change(std::size_t axis) noexcept;
  double with_lost_edges(std::size_t axis, double position) noexcept;

  std::unique_ptr<TablePhysics> physics_;
  std::vector<TableAxis> axes_;
  std::vector<DelayLine> feedback_;                  // of the encoders
  std::array<double, kServoAxes> reported_{};        // behind it [mm]
  std::array<double, kServoAxes> external_force_{};  // [N]
  std::vector<Change> changes_;
  std::vector<Changing> changing_;  // of each axis; empty without changes
  double pen_reference_ = 0.0;      // [mm]
  double step_;                     // physics step [s]
  int steps_;                       // physics steps in a period
  std::int64_t steps_done_ = 0;     // since open()
  bool is_unstable_ = false;
  std::array<char, 200> mujoco_words_{};  // kept without allocating
};

}  // namespace twin::hal::mujoco
