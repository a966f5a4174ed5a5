#pragma once

#include <mujoco/mujoco.h>

#include "core/error.hpp"

/// Names and places of the table's MJCF model, for whoever draws it. Conventions: mjcf/README.md.
namespace twin::hal::mujoco {

inline constexpr const char* kJointX = "x";  ///< slide [m]; positive: the pen goes to +x
inline constexpr const char* kJointY = "y";  ///< slide [m]; positive: the pen goes to +y
inline constexpr const char* kJointZ = "z";  ///< slide [m]; positive: the pen lifts
inline constexpr const char* kPlateBody = "plate";
inline constexpr const char* kPlateGeom = "plate_top";
inline constexpr const char* kPenSite = "pen_tip";
inline constexpr const char* kDrawingTexture = "drawing";
inline constexpr const char* kCameraIso = "iso";
inline constexpr const char* kCameraTop = "top";

/// The texture "drawing" covers the plate once: kDrawingTexels x kDrawingTexels texels, RGB, row 0
/// at +y.
inline constexpr int kDrawingTexels = 2048;
/// Half the side of the square that the texture covers, centred on machine position (0, 0) [mm].
inline constexpr double kDrawingHalfSide = 215.0;
inline constexpr double kTexelsPerMm = kDrawingTexels / (2.0 * kDrawingHalfSide);  ///< [texel/mm]

/// Column in the texture of a machine position x [mm]; the centre of texel i is at i + 0.5.
constexpr double drawing_column(double x) { return (x + kDrawingHalfSide) * kTexelsPerMm; }
/// Row in the texture of a machine position y [mm], counted from the top.
constexpr double drawing_row(double y) { return (kDrawingHalfSide - y) * kTexelsPerMm; }

/// Where the three positions sit in mjData::qpos.
struct TablePose {
  int x = -1;
  int y = -1;
  int z = -1;
};

/// Looks the joints up; kModel error naming the one that is missing.
Expected<TablePose> find_table_pose(const mjModel& model);

/// Puts the table at a machine position [mm]; call mj_kinematics or mj_forward afterwards.
void set_table_pose(const TablePose& pose, mjData& data, double x, double y, double z) noexcept;

}  // namespace twin::hal::mujoco
