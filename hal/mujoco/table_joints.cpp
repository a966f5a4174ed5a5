#include "hal/mujoco/table_joints.hpp"

#include <fmt/format.h>

#include "core/units.hpp"
#include "hal/mujoco/model.hpp"
#include "hal/mujoco/mujoco_library.hpp"

namespace twin::hal::mujoco {
namespace {

constexpr double kPerMInPerMm = 1000.0;  // stiffness and damping per mm in one per m
constexpr const char* kAxisNames[kServoAxes] = {"x", "y"};

Expected<SlideJoint> find_joint(const mjModel& model, const std::string& name, mjtJoint type) {
  TWIN_TRY(const int id, find_id(model, mjOBJ_JOINT, "joint", name));
  if (model.jnt_type[id] != type) {
    return fail(ErrorCode::kModel, fmt::format("joint \"{}\" of the model is not a {} joint", name,
                                               type == mjJNT_SLIDE ? "slide" : "hinge"));
  }
  return SlideJoint{
      .body = model.jnt_bodyid[id], .qpos = model.jnt_qposadr[id], .dof = model.jnt_dofadr[id]};
}

Expected<AxisJoints> find_axis(const mjModel& model, const std::string& name) {
  AxisJoints axis;
  TWIN_TRY(SlideJoint slide, find_joint(model, name, mjJNT_SLIDE));
  axis.slide = slide;
  axis.screw = MujocoLibrary::loaded().name_to_id(&model, mjOBJ_TENDON, (name + "_screw").c_str());
  if (axis.screw < 0) {
    return axis;
  }
  TWIN_TRY(const SlideJoint motor, find_joint(model, name + "_motor", mjJNT_HINGE));
  axis.motor = motor;
  const int first = model.tendon_adr[axis.screw];
  if (model.tendon_num[axis.screw] != 2 || model.wrap_type[first] != mjWRAP_JOINT ||
      model.jnt_dofadr[model.wrap_objid[first]] != axis.slide.dof ||
      model.jnt_dofadr[model.wrap_objid[first + 1]] != axis.motor.dof) {
    return fail(ErrorCode::kModel, fmt::format("tendon {0}_screw of the model must be a fixed one "
                                               "of joint {0}, then of joint {0}_motor",
                                               name));
  }
  return axis;
}

void apply_axis(mjModel& model, const AxisJoints& joints, const AxisParams& params) {
  if (!joints.is_compliant()) {
    model.dof_armature[joints.slide.dof] = params.rotor_mass();
    return;
  }
  const int first = model.tendon_adr[joints.screw];
  model.dof_armature[joints.slide.dof] = 0.0;
  model.dof_armature[joints.motor.dof] = params.motor.rotor_inertia;
  model.wrap_prm[first] = 1.0;
  model.wrap_prm[first + 1] = -units::m_from_mm(params.mm_per_rad());
  model.tendon_stiffness[joints.screw] = params.screw.stiffness * kPerMInPerMm;
  model.tendon_damping[joints.screw] = params.screw.damping * kPerMInPerMm;
}

}  // namespace

Expected<TableJoints> find_table_joints(const mjModel& model) {
  TableJoints joints;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    TWIN_TRY(AxisJoints found, find_axis(model, kAxisNames[axis]));
    joints.axis[axis] = found;
  }
  TWIN_TRY(const SlideJoint pen, find_joint(model, "z", mjJNT_SLIDE));
  joints.pen = pen;
  if (model.body_parentid[joints.axis[kX].slide.body] != joints.axis[kY].slide.body) {
    return fail(ErrorCode::kModel, "the body of joint x must sit on the body of joint y");
  }
  return joints;
}

Expected<void> apply_params(mjModel& model, mjData& data, const TableJoints& joints,
                            const TableParams& params) {
  const double x_mass = params.axis[kX].moving_mass;
  const double saddle_mass = params.axis[kY].moving_mass - x_mass;
  if (!(saddle_mass > 0.0)) {
    return fail(ErrorCode::kModel,
                fmt::format("table.y.moving_mass_kg = {} must exceed table.x.moving_mass_kg = {}: "
                            "the Y axis carries the X axis",
                            params.axis[kY].moving_mass, x_mass));
  }
  model.body_mass[joints.axis[kX].slide.body] = x_mass;
  model.body_mass[joints.axis[kY].slide.body] = saddle_mass;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    apply_axis(model, joints.axis[axis], params.axis[axis]);
  }
  MujocoLibrary::loaded().set_const(&model, &data);
  return {};
}

}  // namespace twin::hal::mujoco
