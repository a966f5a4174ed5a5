#pragma once

#include <cstdint>

#include "core/error.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig {

/// Whether the signal of a digital line is given, as by Line::when; false if it is not wired.
/// @param levels  levels of all lines, bit i for line i
bool is_given(const Line& line, std::uint16_t levels) noexcept;

/// Returns the levels with the signal of a line given or not; unchanged if it is not wired.
std::uint16_t with_signal(const Line& line, bool given, std::uint16_t levels) noexcept;

/// Digital outputs with no signal given: every drive off, no alarm reset. Lines that no axis uses
/// are low.
std::uint16_t safe_digital(const RigSettings& settings) noexcept;

/// The signals of a drive.
struct DriveInputs {
  bool ready = false;           ///< /S-RDY is given, and /S-ON was asked for
  bool alarm = false;           ///< true: alarm, or a broken wire
  bool limit_positive = false;  ///< true: P-OT reached, or a broken wire
  bool limit_negative = false;  ///< true: N-OT reached, or a broken wire
};

/// One Yaskawa drive (Servopack) in speed mode, behind its wires. All calls are real-time safe.
///
/// The settings say for each line at which level its signal is given (Line). A broken wire reads as
/// the level of an open input, which is low. ALM, P-OT and N-OT are given at low, so a broken wire
/// reads as an alarm or a limit.
class Servopack {
 public:
  explicit Servopack(const AxisWiring& wiring) noexcept : wiring_(wiring) {}

  const AxisWiring& wiring() const noexcept { return wiring_; }

  /// V-REF for a drive command: while the servo is on, the trim against the drive's offset is
  /// added [V].
  double vref(double command, bool servo_on) const noexcept;
  /// Returns the digital outputs with /S-ON and /ALM-RST of this drive set as asked.
  std::uint16_t with_outputs(bool servo_on, bool alarm_reset, std::uint16_t levels) const noexcept;
  /// Reads the signals of this drive from the digital inputs.
  ///
  /// A drive may give /S-RDY before /S-ON, to say that it can be switched on. So `ready` here needs
  /// both.
  /// @param levels    digital inputs, bit i for line i
  /// @param servo_on  /S-ON as last asked for; if /S-RDY is not wired, `ready` is just this
  DriveInputs decode(std::uint16_t levels, bool servo_on) const noexcept;

  /// Encoder scale, with sign [mm/count]. @param table  scale of the table, if the setting is 0
  double mm_per_count(double table) const noexcept;
  /// V-REF scale, with sign [mm/s/V]. @param table  scale of the table, if the setting is 0
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
