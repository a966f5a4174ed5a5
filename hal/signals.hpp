#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// The signals at the wires between controller and machine, as plain structs.
namespace twin::hal {

inline constexpr std::size_t kServoAxes = 2;  ///< X and Y: volts out, encoder counts in
enum Axis : std::size_t { kX = 0, kY = 1 };

/// Controller to machine, written once a period.
struct Outputs {
  std::array<double, kServoAxes> volts{};   ///< drive command V-REF [V], +-10
  std::array<bool, kServoAxes> servo_on{};  ///< /S-ON of each drive
  std::array<double, 3>
      position_reference{};  ///< set point x, y, z [mm], for axes whose loop is closed in the
                             ///< machine: all of the ideal machine, the Z pen slide of the table
};

/// Machine to controller, read once a period.
struct Inputs {
  std::array<std::int64_t, kServoAxes>
      counts{};  ///< encoder, quadrature edges since activation [counts]
  std::array<bool, kServoAxes> servo_ready{};     ///< /S-RDY
  std::array<bool, kServoAxes> alarm{};           ///< true: drive alarm
  std::array<bool, kServoAxes> limit_positive{};  ///< true: P-OT reached
  std::array<bool, kServoAxes> limit_negative{};  ///< true: N-OT reached
  std::array<bool, kServoAxes> index{};           ///< true: the encoder's index was met since the
                                                  ///< last read(); false where it has none
};

/// What only a simulated machine knows: where the table really is.
struct Truth {
  std::array<double, kServoAxes> table_position{};  ///< [mm]
};

}  // namespace twin::hal
