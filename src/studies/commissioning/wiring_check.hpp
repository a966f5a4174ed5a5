#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <string>

#include "core/error.hpp"
#include "hal/machine.hpp"

/// Bringing a machine up, before its position loops are ever closed, and homing it after.
namespace twin::studies::commissioning {

/// How far and how fast the wiring check moves an axis.
struct WiringCheckSettings {
  double velocity = 4.0;        ///< commanded, each way in turn [mm/s]
  double pulse = 0.15;          ///< length of each [s]
  double rest = 0.15;           ///< before, between and after [s]
  double largest_travel = 1.5;  ///< of any axis; beyond it the check ends at once [mm]
  double ready_timeout = 2.0;   ///< from /S-ON to /S-RDY [s]
};

/// The state of an axis' wiring.
enum class Finding {
  kSound,
  kReversed,   ///< moves against the command: closing the loop would make it run away
  kScale,      ///< moves by another amount than the settings say
  kNoMotion,   ///< its counts stand still
  kOtherAxis,  ///< the other axis' counts move
};

/// What the check found on one axis.
struct AxisWiringReport {
  Finding finding = Finding::kSound;
  double drift = 0.0;           ///< velocity at 0 V [mm/s]
  double expected_scale = 0.0;  ///< of the settings [mm/s/V]
  double measured_scale = 0.0;  ///< [mm/s/V]
  double other_scale = 0.0;     ///< what the other axis shows meanwhile [mm/s/V]

  /// Offset of the drive, which a trim of the opposite sign takes away [V].
  double offset() const { return drift / expected_scale; }
};

using WiringReport = std::array<AxisWiringReport, hal::kServoAxes>;

/// What passes between two periods: a sleep on the wall clock, nothing in simulated time.
using WaitForPeriod = std::function<void()>;

/// Moves one axis after the other by a few tenths of a millimetre, open loop, and compares what its
/// encoder shows with what the settings say.
///
/// For each axis the servo is switched on while that of the other axis is off. The command is 0 V
/// until the drive is ready and for `rest` after that, which shows the drift. Then it is +V and -V
/// for `pulse` each, with V = velocity / scale. The mean velocities v+ and v- over the second half
/// of each pulse give the measured scale
///   (v+ - v-) / (2 V),
/// from which the drive's offset cancels. Below 10 % of the expected scale there is no motion;
/// within 20 % of it the axis is sound.
///
/// @param machine  unconfigured; left with 0 V, servo off, unconfigured
/// @param period   time between two exchanges [s]
/// @param stop     set from outside: ends it with 0 V at once
/// @returns the report, or why the check could not be made: an alarm, a limit switch, a drive that
/// is not ready, more motion than allowed
Expected<WiringReport> check_wiring(hal::Machine& machine, const WiringCheckSettings& settings,
                                    double period, const WaitForPeriod& wait,
                                    const std::atomic<bool>& stop);

/// What was found and what to do about it, one line.
std::string advice(const AxisWiringReport& report, const std::string& axis);

}  // namespace twin::studies::commissioning
