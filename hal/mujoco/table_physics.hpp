#pragma once

#include <memory>

#include "core/error.hpp"
#include "hal/mujoco/model.hpp"
#include "hal/mujoco/mujoco_library.hpp"
#include "hal/mujoco/table_axis.hpp"
#include "hal/mujoco/table_joints.hpp"
#include "hal/mujoco/table_params.hpp"

namespace twin::hal::mujoco {

/// The masses of the table in MuJoCo: the one place where mm meet m.
///
/// MuJoCo integrates M a = f by its semi-implicit Euler step, v' = v + h a, q' = q + h v', without
/// contacts and constraints; f is qfrc_applied, which stays until it is overwritten, so every entry
/// is set before every step.
class TablePhysics {
 public:
  /// Loads params.model and gives it the masses, rotors and screws of the parameters.
  /// @param step physics step [s]
  static Expected<std::unique_ptr<TablePhysics>> open(const TableParams& params, double step);

  /// Where an axis is. Real-time safe.
  AxisMotion motion(std::size_t axis) const noexcept;
  /// What the encoder sees, on the motor as travel or on the slide [mm]. Real-time safe.
  double encoder_position(std::size_t axis) const noexcept;
  /// Height of the pen [mm]. Real-time safe.
  double pen_position() const noexcept;

  /// Whether the screw of an axis gives.
  bool has_screw(std::size_t axis) const noexcept { return joints_.axis[axis].is_compliant(); }
  /// Lets stiffness, play and mass differ from their parameters from the next step on. Real-time
  /// safe.
  void set_condition(std::size_t axis, const AxisCondition& condition) noexcept;

  /// Forces of the coming step. Real-time safe.
  void apply(std::size_t axis, const AxisForces& forces) noexcept;
  /// Pulls the pen slide to its reference like a critically damped spring [mm]. Real-time safe.
  void pull_pen(double reference) noexcept;
  /// One physics step; throws MujocoError where MuJoCo would end the process. Allocates nothing.
  void step();
  /// True once a number went bad: MuJoCo then resets the state by itself and only counts that.
  bool is_unstable() const noexcept;

 private:
  TablePhysics(ModelPtr model, DataPtr data, const TableJoints& joints, const TableParams& params);

  const MujocoLibrary& mujoco_ = MujocoLibrary::loaded();
  ModelPtr model_;
  DataPtr data_;
  TableJoints joints_;
  std::array<double, kServoAxes> mm_per_rad_;
  double pen_omega_;                                       // bandwidth of the pen slide [rad/s]
  double motor_position(std::size_t axis) const noexcept;  // as travel [mm]
  double screw_force(std::size_t axis) const noexcept;

  struct Screw {
    double stiffness = 0.0;  // [N/mm]
    double damping = 0.0;    // [N s/mm]
    double backlash = 0.0;   // [mm]
    double mass = 0.0;       // added to the slide [kg]
    bool is_ours = false;    // its force is computed here, not by MuJoCo
  };
  std::array<ScrewParams, kServoAxes> screws_;
  std::array<EncoderPlace, kServoAxes> encoder_at_;
  std::array<Screw, kServoAxes> changed_{};
};

}  // namespace twin::hal::mujoco
