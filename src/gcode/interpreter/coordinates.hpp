#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "core/vec.hpp"
#include "gcode/block.hpp"

namespace twin::gcode {

/// The coordinate system of a workpiece.
struct WorkOffset {
  Vec3 origin = Vec3::Zero();  ///< in machine coordinates [mm]
  double rotation_deg = 0.0;   ///< of its X axis about Z, counter-clockwise
};

/// What G51, G51.1 and G68 lay over the coordinates of the program:
///   q = c + T (p - c)
struct Overlay {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< T
  Vec3 centre = Vec3::Zero();                          ///< c [mm]
  bool is_on = false;
};

/// Where the coordinates of a program lie on the machine.
///
///   m = w + R(theta) (G(S(p)) + s) + t + l                                                (1)
/// Here p is the place in the program and m that on the machine. S is the scaling or mirror image of
/// G51 and G51.1, G the rotation of G68, s the shift of G52 and G92, w and theta are origin and
/// rotation of the work offset in force (G54 to G59.3), t is the tool's offset (G43), and l is where
/// the user has put the workpiece. All lengths are in mm. (1) is of the form m = A p + b, where A is
/// a rotation times a factor, with a mirror image or without. Source of the order: LinuxCNC, G-Code
/// manual, "Coordinate Systems"; shift and work offset are kept as parameters 5210 to 5390 there.
class Coordinates {
 public:
  static constexpr std::size_t kSystems = 9;     ///< G54 to G59, G59.1 to G59.3
  static constexpr std::size_t kExtended = 300;  ///< G54.1 P1 to P300, behind them

  Coordinates() { update(); }

  /// @param placement  l of (1) [mm]
  void place_workpiece(const Vec3& placement);

  Vec3 machine_of(const Vec3& program) const noexcept;
  Vec3 program_of(const Vec3& machine) const noexcept;

  /// Height on the machine of the program's origin [mm].
  double height_of_origin() const noexcept { return b_.z(); }

  /// True while A of (1) is the identity.
  bool is_shift_only() const noexcept { return is_shift_only_; }
  /// True while machine_of() returns what it is given.
  bool is_identity() const noexcept { return is_identity_; }
  /// Factor of A; it is 1 unless G51 scales.
  double factor() const noexcept { return factor_; }
  /// True where A has a mirror image in it.
  bool is_mirrored() const noexcept { return is_mirrored_; }

  /// Brings an arc to the machine.
  geometry::Arc machine_arc(const geometry::Arc& arc) const;

  /// Changes whenever (1) does.
  std::uint64_t version() const noexcept { return version_; }

  /// Origin that a work offset needs for a place on the machine to have certain coordinates in it.
  ///
  /// @param change  gets the place's coordinates in that system and changes those that are wanted
  Vec3 origin_for(std::size_t system, const Vec3& machine,
                  const std::function<void(Vec3&)>& change) const;
  /// Coordinates of a place on the machine in G59.3 without shift and tool [mm].
  Vec3 fixture_place(const Vec3& machine) const;

  /// Puts a work offset in force. @param system  0 for G54
  void select(std::size_t system);
  std::size_t selected() const noexcept { return selected_; }
  const WorkOffset& stored(std::size_t system) const;
  /// Stores a work offset; it is in force at once if it is the one selected.
  void store(std::size_t system, const WorkOffset& offset);

  const Vec3& shift() const noexcept { return shift_; }  ///< G52, G92; whether on or off [mm]
  bool is_shift_on() const noexcept { return is_shift_on_; }
  void set_shift(const Vec3& shift, bool is_on);

  const Vec3& tool() const noexcept { return tool_; }  ///< [mm]
  void set_tool(const Vec3& offset);

  void set_rotation(const Overlay& rotation);  ///< G68, G69
  void set_scaling(const Overlay& scaling);    ///< G51, G51.1, G50, G50.1
  const Overlay& scaling() const noexcept { return scaling_; }
  const Overlay& rotation() const noexcept { return rotation_; }

  /// A parameter of the control, 5210 to 5390 [mm, deg, or the number of a system], if it is one of
  /// these.
  std::optional<double> parameter(int number) const;
  /// Sets one. A work offset then takes effect when it is next selected.
  /// @returns false if the number is none of them
  bool set_parameter(int number, double value);

 private:
  void update();

  std::array<WorkOffset, kSystems + kExtended> stored_{};
  std::size_t selected_ = 0;
  WorkOffset active_;
  Vec3 shift_ = Vec3::Zero();
  bool is_shift_on_ = false;
  Vec3 tool_ = Vec3::Zero();
  Vec3 placement_ = Vec3::Zero();
  Overlay rotation_;
  Overlay scaling_;

  // Of (1), from the above.
  Eigen::Matrix3d a_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d inverse_ = Eigen::Matrix3d::Identity();
  Vec3 b_ = Vec3::Zero();
  double factor_ = 1.0;
  std::uint64_t version_ = 0;
  bool is_mirrored_ = false;
  bool is_shift_only_ = true;
  bool is_identity_ = true;
};

/// Rotation about an axis of the plane's third direction.
///
/// @param axis       0 to 2
/// @param angle_deg  counter-clockwise, seen from the tip of the axis
Eigen::Matrix3d rotation_about(int axis, double angle_deg);

}  // namespace twin::gcode
