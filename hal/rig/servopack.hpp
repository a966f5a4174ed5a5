#pragma once

#include <cstdint>

#include "core/error.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig {

/// True if the signal of a digital line is given at these levels; false where it is not wired.
bool is_given(const Line& line, std::uint16_t levels) noexcept;

/// These levels with the signal of a line given or not; unchanged where it is not wired.
std::uint16_t with_signal(const Line& line, bool given, std::uint16_t levels) noexcept;

/// Digital outputs with no signal given: every drive off, no alarm reset. Lines that no axis uses
/// are low.
std::uint16_t safe_digital(const RigSettings& settings) noexcept;

/// What a drive says.
struct DriveInputs {
  bool ready = false;           ///< /S-RDY, and the servo is asked to be on
  bool alarm = false;           ///< true: alarm, or a broken wire
  bool limit_positive = false;  ///< true: P-OT reached, or a broken wire
  bool limit_negative = false;  ///< true: N-OT reached, or a broken wire
};

/// One Yaskawa drive (Servopack) in speed mode, behind its wires. All calls are real-time safe.
///
/// The sense of a line (active high or low, normally closed) is that of its `Line`: a wire that
/// breaks reads as the level of an open input, low, and with ALM, P-OT and N-OT given at low that
/// is an alarm or a limit.
class Servopack {
 public:
  explicit Servopack(const AxisWiring& wiring) noexcept : wiring_(wiring) {}

  const AxisWiring& wiring() const noexcept { return wiring_; }

  /// V-REF for a drive command: trimmed against the drive's offset while the servo is on [V].
  double vref(double command, bool servo_on) const noexcept;
  /// Digital outputs with servo-on and alarm reset of this drive as asked.
  std::uint16_t with_outputs(bool servo_on, bool alarm_reset, std::uint16_t levels) const noexcept;
  /// What the digital inputs say.
  ///
  /// A drive may give /S-RDY before /S-ON, to say that it would take it. Ready needs both here.
  /// @param servo_on  as last asked; alone where /S-RDY is not wired
  DriveInputs decode(std::uint16_t levels, bool servo_on) const noexcept;

  /// Encoder scale, signed [mm/count]. @param table  used where the setting is 0
  double mm_per_count(double table) const noexcept;
  /// V-REF scale, signed [mm/s/V]. @param table  used where the setting is 0
  double mm_per_s_per_volt(double table) const noexcept;

 private:
  AxisWiring wiring_;
};

/// True if a drive has an alarm (or its wire is broken).
bool has_alarm(const RigSettings& settings, std::uint16_t inputs) noexcept;

/// Checks what the drives say before they are switched on.
///
/// Refused are a drive with an alarm, and an axis at both its limits at once: no table can be, so
/// the cable to that drive is off.
/// @param inputs  digital inputs of the PCI-1716
/// @returns a kMachine error that names axis, signal, channel and level
Expected<void> check_drives(const RigSettings& settings, std::uint16_t inputs);

}  // namespace twin::hal::rig
