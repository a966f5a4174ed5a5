#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "twin/error.hpp"
#include "twin/export.hpp"

/// The seam between controller and plant: the signals at its wires as plain structs, and a machine.
namespace twin {

inline constexpr std::size_t kServoAxes = 2;  ///< X and Y: volts out, encoder counts in
enum Axis : std::size_t { kX = 0, kY = 1 };

/// Controller to machine, written once a period.
struct Outputs {
  std::array<double, kServoAxes> volts{};   ///< drive command V-REF [V], +-10
  std::array<bool, kServoAxes> servo_on{};  ///< /S-ON of each drive
  /// Set point x, y, z [mm], for axes whose loop is closed in the machine: all of the ideal
  /// machine, the Z pen slide of the table.
  std::array<double, 3> position_reference{};
};

/// Machine to controller, read once a period.
struct Inputs {
  /// Encoders: quadrature edges since activation [counts].
  std::array<std::int64_t, kServoAxes> counts{};
  std::array<bool, kServoAxes> servo_ready{};     ///< /S-RDY
  std::array<bool, kServoAxes> alarm{};           ///< true: drive alarm
  std::array<bool, kServoAxes> limit_positive{};  ///< true: P-OT reached
  std::array<bool, kServoAxes> limit_negative{};  ///< true: N-OT reached
  /// True: the encoder's index was met since the last read(); always false where it has none.
  std::array<bool, kServoAxes> index{};
};

/// What only a simulated machine knows: where the table really is.
struct Truth {
  std::array<double, kServoAxes> table_position{};  ///< [mm]
};

/// Result of a call in the cycle.
enum class MachineStatus : std::uint8_t {
  kOk,
  kError,  ///< the machine is no longer under control; last_error() says why
};

/// States of a machine, and what the drives do in each.
///
///   state         | drives                  | leaves by
///   --------------+-------------------------+--------------------------------------------------
///   kUnconfigured | untouched               | configure() -> kInactive
///   kInactive     | 0 V, servo off          | activate() -> kActive, cleanup() -> kUnconfigured
///   kActive       | commanded, servo on     | deactivate() -> kInactive
///
/// Whatever fails, the machine is left with 0 V and servo off, and goes to kInactive.
enum class MachineState : std::uint8_t { kUnconfigured, kInactive, kActive };

/// What a controller must know of a machine before it moves.
struct MachineInfo {
  std::string name;             ///< "mujoco", "ideal", "rig"
  bool simulated = true;        ///< false only where metal moves
  bool has_truth = true;        ///< truth() means something
  bool keeps_own_time = false;  ///< its periods pass on the wall clock, not inside read()
  /// The position equals the reference handed to write(); measured values are those of truth()
  /// after write().
  bool follows_reference = false;
  std::array<double, kServoAxes> mm_per_count{};       ///< encoder scale, signed [mm/count]
  std::array<double, kServoAxes> mm_per_s_per_volt{};  ///< V-REF scale, signed [mm/s/V]
};

/// A machine behind its wires.
///
/// Order in a period: read(), interpolate, servo, write() last. For a simulated machine one period
/// of time passes inside read(); for a real one it passes on the wall clock.
///
/// configure() and activate() return nothing, or why not.
class TWIN_EXPORT Machine {
 public:
  Machine() = default;
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;
  virtual ~Machine() = default;

  virtual const MachineInfo& info() const noexcept = 0;

  /// Opens models or cards. Not real-time safe. @param period interpolation period [s]
  [[nodiscard]] virtual std::optional<Error> configure(double period) = 0;
  /// Switches the drives on at the present position, which becomes zero counts. Not real-time safe.
  [[nodiscard]] virtual std::optional<Error> activate() = 0;

  /// Lets one period pass (simulated machines) and fetches the inputs of this instant. Real-time
  /// safe.
  virtual MachineStatus read(Inputs& inputs) noexcept = 0;
  /// Hands over the outputs that hold until the next write(). Real-time safe.
  virtual MachineStatus write(const Outputs& outputs) noexcept = 0;
  /// True position at the instant of the last read(). Real-time safe.
  virtual Truth truth() const noexcept = 0;

  /// 0 V and servo off, in that order. Safe to call in every state. Not real-time safe.
  virtual void deactivate() noexcept = 0;
  /// Releases everything configure() took. Not real-time safe.
  virtual void cleanup() noexcept = 0;

  /// Why the last call returned kError; empty when none did. Not real-time safe.
  virtual std::string last_error() const = 0;
};

}  // namespace twin
