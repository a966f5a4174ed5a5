#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "core/error.hpp"
#include "hal/mujoco/table_params.hpp"

namespace twin::hal::mujoco {

/// Where one slide sits in the model's vectors, and its motor if the screw gives.
struct SlideJoint {
  int body = -1;
  int qpos = -1;
  int dof = -1;
};
struct AxisJoints {
  SlideJoint slide;
  SlideJoint motor;  ///< hinge of the rotor; absent in the rigid model
  int screw = -1;    ///< tendon between the two; absent in the rigid model

  bool is_compliant() const noexcept { return screw >= 0; }
};

/// Joints of the whole table in a model.
struct TableJoints {
  std::array<AxisJoints, kServoAxes> axis;
  SlideJoint pen;
};

/// Looks up the slides "x", "y", "z" and, where there is a tendon "x_screw" or "y_screw", the hinge
/// "x_motor" or "y_motor". Missing names and joints of the wrong type are kModel errors.
Expected<TableJoints> find_table_joints(const mjModel& model);

/// Writes masses, rotor inertia and screws of the parameters into the model, so that the parameters
/// alone decide.
///
/// The X axis moves its own mass, the Y axis that and the saddle's. With a rigid screw the rotor is
/// the armature of the slide, J (2 pi / lead)^2; with a compliant one it is the armature of the
/// hinge, and the tendon's length q_slide - (lead / 2 pi) q_motor is what stretches the screw.
Expected<void> apply_params(mjModel& model, mjData& data, const TableJoints& joints,
                            const TableParams& params);

}  // namespace twin::hal::mujoco
