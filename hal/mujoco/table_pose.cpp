#include "hal/mujoco/table_pose.hpp"

#include "core/units.hpp"
#include "hal/mujoco/model.hpp"

namespace twin::hal::mujoco {

Expected<TablePose> find_table_pose(const mjModel& model) {
  TablePose pose;
  for (const auto& [name, address] :
       {std::pair{kJointX, &pose.x}, std::pair{kJointY, &pose.y}, std::pair{kJointZ, &pose.z}}) {
    TWIN_TRY(const int id, find_id(model, mjOBJ_JOINT, "joint", name));
    *address = model.jnt_qposadr[id];
  }
  return pose;
}

void set_table_pose(const TablePose& pose, mjData& data, double x, double y, double z) noexcept {
  data.qpos[pose.x] = units::m_from_mm(x);
  data.qpos[pose.y] = units::m_from_mm(y);
  data.qpos[pose.z] = units::m_from_mm(z);
}

}  // namespace twin::hal::mujoco
