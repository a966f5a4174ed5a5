#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "twin/error.hpp"
#include "twin/export.hpp"

/// The seam between controller and machine: the signals on the wires as plain structs, and the
/// interface that every machine implements.
namespace twin {

/// Number of axes whose position loop the controller closes: X and Y. It writes their drive command
/// in volts and reads their encoder counts.
inline constexpr std::size_t kServoAxes = 2;
enum Axis : std::size_t { kX = 0, kY = 1 };

/// Signals from the controller to the machine, written once a period.
struct Outputs {
  std::array<double, kServoAxes> volts{};   ///< drive command V-REF, -10 to 10 [V]
  std::array<bool, kServoAxes> servo_on{};  ///< /S-ON of each drive
  /// Set point x, y, z [mm]. It is for axes whose position loop is closed inside the machine: all
  /// three axes of the ideal machine, and the pen slide (Z) of the table.
  std::array<double, 3> position_reference{};
};

/// Signals from the machine to the controller, read once a period.
struct Inputs {
  /// Position of each encoder: quadrature edges since activate(), signed [counts].
  std::array<std::int64_t, kServoAxes> counts{};
  std::array<bool, kServoAxes> servo_ready{};     ///< /S-RDY: the drive follows its command
  std::array<bool, kServoAxes> alarm{};           ///< true: the drive gives an alarm
  std::array<bool, kServoAxes> limit_positive{};  ///< true: on the limit switch P-OT
  std::array<bool, kServoAxes> limit_negative{};  ///< true: on the limit switch N-OT
  /// True: the encoder has passed its index mark since the last read(). Always false for an encoder
  /// without an index.
  std::array<bool, kServoAxes> index{};
  /// Periods that have passed since the last read() of a machine that gives the beat: 1, or more
  /// where the controller was late. Always 1 for another machine.
  int periods = 1;
};

/// Where the table really is. Only a simulated machine knows this; a real one has its encoders.
struct Truth {
  std::array<double, kServoAxes> table_position{};  ///< [mm]
  /// Torque of each motor, 0 unless info().has_forces [N.m].
  std::array<double, kServoAxes> motor_torque{};
  /// Friction of each slide, positive against positive motion, 0 unless info().has_forces [N].
  std::array<double, kServoAxes> friction_force{};
};

/// Result of read() and write(), the two calls of every period.
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
/// Whatever fails, the machine puts its drives at 0 V and servo off and goes to kInactive.
enum class MachineState : std::uint8_t { kUnconfigured, kInactive, kActive };

/// What a controller must know about a machine before it moves.
struct MachineInfo {
  std::string name;             ///< name in the summary, such as "mujoco", "ideal" or "rig"
  bool simulated = true;        ///< false if real axes move
  bool has_truth = true;        ///< whether truth() returns the true position
  bool has_forces = false;      ///< whether truth() returns torques and friction
  bool keeps_own_time = false;  ///< true: time passes on the wall clock, not inside read()
  /// True: the machine has periods of its own and read() waits for the begin of the next one, so
  /// that the controller follows its clock. Goes with keeps_own_time.
  bool gives_beat = false;
  /// True: the machine stands exactly at the reference that was last handed to write(). Its
  /// measured position is then truth() after write(), and the monitors do not watch it.
  bool follows_reference = false;
  std::array<double, kServoAxes> mm_per_count{};       ///< encoder scale, with sign [mm/count]
  std::array<double, kServoAxes> mm_per_s_per_volt{};  ///< V-REF scale, with sign [mm/s/V]
};

/// A machine as the controller sees it through the wires: implement this to drive one of your own
/// (docs/examples/04_own_machine.cpp).
///
///   configure, activate | read, write | read, write | ... | deactivate, cleanup
///                         one period
///
/// In each period the controller reads the inputs, computes set point and drive command, and writes
/// the outputs. For a simulated machine one period of time passes inside read(); for a real one it
/// passes on the wall clock. All calls come from one thread at a time.
class TWIN_EXPORT Machine {
 public:
  Machine() = default;
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;
  virtual ~Machine() = default;

  virtual const MachineInfo& info() const noexcept = 0;

  /// Opens what the machine needs, such as a model or the I/O cards. Not real-time safe.
  /// @param period  interpolation period, the time from one read() to the next [s]
  /// @returns nothing if the machine is now inactive, else why it could not be configured
  [[nodiscard]] virtual std::optional<Error> configure(double period) = 0;
  /// Switches the drives on at the present position, where the counts start from zero. Not
  /// real-time safe.
  /// @returns nothing if the machine is now active, else why it could not be activated
  [[nodiscard]] virtual std::optional<Error> activate() = 0;

  /// Fetches the inputs of this instant. A simulated machine lets one period pass first. Real-time
  /// safe.
  virtual MachineStatus read(Inputs& inputs) noexcept = 0;
  /// Sets the outputs, which stay until the next write(). Real-time safe.
  virtual MachineStatus write(const Outputs& outputs) noexcept = 0;
  /// True position at the instant of the last read(); if info().follows_reference is true, that of
  /// the last write(). Real-time safe.
  virtual Truth truth() const noexcept = 0;

  /// Sets 0 V, then switches the servos off. May be called in every state. Not real-time safe.
  virtual void deactivate() noexcept = 0;
  /// Releases everything that configure() opened. Not real-time safe.
  virtual void cleanup() noexcept = 0;

  /// Why the last read() or write() returned kError; empty if none did. Not real-time safe.
  virtual std::string last_error() const = 0;
};

}  // namespace twin
