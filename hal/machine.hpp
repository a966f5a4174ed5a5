#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/error.hpp"
#include "hal/signals.hpp"

namespace twin::hal {

/// Result of a call in the cycle.
enum class Status : std::uint8_t {
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
enum class State : std::uint8_t { kUnconfigured, kInactive, kActive };

/// What a controller must know of a machine before it moves.
struct MachineInfo {
  std::string name;                ///< "mujoco", "ideal", "rig"
  bool simulated = true;           ///< false only where metal moves
  bool has_truth = true;           ///< truth() means something
  bool keeps_own_time = false;     ///< its periods pass on the wall clock, not inside read()
  bool follows_reference = false;  ///< position equals the reference handed to write(); measured
                                   ///< values are those of truth() after write()
  std::array<double, kServoAxes> mm_per_count{};       ///< encoder scale, signed [mm/count]
  std::array<double, kServoAxes> mm_per_s_per_volt{};  ///< V-REF scale, signed [mm/s/V]
};

/// A machine behind its wires: the seam between controller and plant.
///
/// Order in a period: read(), interpolate, servo, write() last. For a simulated machine one period
/// of time passes inside read(); for a real one it passes on the wall clock.
class Machine {
 public:
  Machine() = default;
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;
  virtual ~Machine() = default;

  virtual const MachineInfo& info() const noexcept = 0;

  /// Opens models or cards. Not real-time safe. @param period interpolation period [s]
  virtual Expected<void> configure(double period) = 0;
  /// Switches the drives on at the present position, which becomes zero counts. Not real-time safe.
  virtual Expected<void> activate() = 0;

  /// Lets one period pass (simulated machines) and fetches the inputs of this instant. Real-time
  /// safe.
  virtual Status read(Inputs& inputs) noexcept = 0;
  /// Hands over the outputs that hold until the next write(). Real-time safe.
  virtual Status write(const Outputs& outputs) noexcept = 0;
  /// True position at the instant of the last read(). Real-time safe.
  virtual Truth truth() const noexcept = 0;

  /// 0 V and servo off, in that order. Safe to call in every state. Not real-time safe.
  virtual void deactivate() noexcept = 0;
  /// Releases everything configure() took. Not real-time safe.
  virtual void cleanup() noexcept = 0;

  /// Why the last call returned kError; empty when none did. Not real-time safe.
  virtual std::string last_error() const = 0;
};

}  // namespace twin::hal
