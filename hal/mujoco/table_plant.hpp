#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "hal/mujoco/table_axis.hpp"
#include "hal/mujoco/table_params.hpp"

namespace twin::hal::mujoco {

class TablePhysics;

/// The servo XY table between the V-REF terminals of its drives and the shafts of its encoders.
///
/// MuJoCo integrates the masses (semi-implicit Euler, no contacts, no constraints); drive and
/// friction act on them as generalised forces, written anew before every physics step. Converters
/// and counters are not part of it. Nothing depends on the wall clock or on other plants in the
/// process: the same calls give the same bytes.
class TablePlant {
 public:
  /// The table at rest in the middle of its travel, servo off, 0 V.
  /// @param period  that advance() lets pass, > 0 [s]
  /// @returns kMachine error for a number out of range, kModel error where the model fails
  static Expected<std::unique_ptr<TablePlant>> open(const TableParams& params, double period);
  ~TablePlant();
  TablePlant(const TablePlant&) = delete;
  TablePlant& operator=(const TablePlant&) = delete;

  /// What the terminals of a drive get from now on. Real-time safe. @param volts V-REF [V], finite
  void command(std::size_t axis, double volts, bool servo_on) noexcept;
  /// Clears the alarm and the states of a drive, servo off. Real-time safe.
  void reset_drive(std::size_t axis) noexcept;
  /// Makes a drive give alarm. Real-time safe.
  void trip(std::size_t axis) noexcept;
  /// Opens limit switches wherever the slide is, or leaves them to it again. Real-time safe.
  void force_limits(std::size_t axis, bool positive, bool negative) noexcept;
  /// Where the pen slide is to be [mm]. Real-time safe.
  void set_pen_reference(double z) noexcept { pen_reference_ = z; }
  /// A force on a slide from outside, until changed, along its positive direction [N]. Real-time
  /// safe.
  void set_external_force(std::size_t axis, double force) noexcept {
    external_force_[axis] = force;
  }

  /// Lets one period pass. Real-time safe. False: the simulation failed and stays as it is,
  /// last_error() says why.
  bool advance() noexcept;

  double position(std::size_t axis) const noexcept;          ///< of the slide [mm]
  double velocity(std::size_t axis) const noexcept;          ///< of the slide [mm/s]
  double encoder_position(std::size_t axis) const noexcept;  ///< of the shaft, as travel [mm]
  double pen_position() const noexcept;                      ///< [mm]
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

  std::unique_ptr<TablePhysics> physics_;
  std::vector<TableAxis> axes_;
  std::array<double, kServoAxes> external_force_{};  // [N]
  double pen_reference_ = 0.0;                       // [mm]
  double step_;                                      // physics step [s]
  int steps_;                                        // physics steps in a period
  std::int64_t steps_done_ = 0;                      // since open()
  bool is_unstable_ = false;
  std::array<char, 200> mujoco_words_{};  // kept without allocating
};

}  // namespace twin::hal::mujoco
