#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <string>

#include "core/error.hpp"
#include "hal/machine.hpp"

/// Commissioning of a machine: a check of its wiring before the position loops are closed for the
/// first time, and homing.
namespace twin::studies::commissioning {

/// How far and how fast the wiring check moves an axis.
struct WiringCheckSettings {
  double velocity = 4.0;        ///< commanded velocity of a pulse, first +, then - [mm/s]
  double pulse = 0.15;          ///< length of a pulse [s]
  double rest = 0.15;           ///< time at 0 V before, between and after the pulses [s]
  double largest_travel = 1.5;  ///< if any axis moves farther, the check ends at once [mm]
  double ready_timeout = 2.0;   ///< longest time from /S-ON to /S-RDY [s]
};

/// The state of an axis' wiring.
enum class Finding {
  kSound,
  kReversed,   ///< the axis moves against the command and would run away in a closed loop
  kScale,      ///< the axis moves by another amount than the settings say
  kNoMotion,   ///< the counts of the axis stand still
  kOtherAxis,  ///< the counts of the other axis move
};

/// What the check found on one axis.
struct AxisWiringReport {
  Finding finding = Finding::kSound;
  double drift = 0.0;           ///< velocity at 0 V [mm/s]
  double expected_scale = 0.0;  ///< V-REF scale by the settings [mm/s/V]
  double measured_scale = 0.0;  ///< V-REF scale as measured [mm/s/V]
  double other_scale = 0.0;     ///< motion of the other axis meanwhile, per volt [mm/s/V]

  /// Offset of the drive; a trim of the opposite sign removes it [V].
  double offset() const { return drift / expected_scale; }
};

using WiringReport = std::array<AxisWiringReport, hal::kServoAxes>;

/// Waits for the next period: sleeps on the wall clock, does nothing in simulated time.
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
/// @param machine  an unconfigured machine; it is left with 0 V, servo off and unconfigured
/// @param period   time between two exchanges with the machine [s]
/// @param wait     called before each exchange
/// @param stop     if set from outside, the check ends with 0 V at once
/// @returns the report, or why the check could not be made: an alarm, a limit switch, a drive that
///          is not ready, more motion than allowed
Expected<WiringReport> check_wiring(hal::Machine& machine, const WiringCheckSettings& settings,
                                    double period, const WaitForPeriod& wait,
                                    const std::atomic<bool>& stop);

/// One line that says what was found on an axis and what to do about it.
std::string advice(const AxisWiringReport& report, const std::string& axis);

}  // namespace twin::studies::commissioning
