#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace twin::motion {

/// What was found wrong.
enum class Kind : std::uint8_t {
  kTrackingError,  ///< set point less measured too large for too long
  kPositiveLimit,  ///< P-OT
  kNegativeLimit,  ///< N-OT
  kDriveAlarm,     ///< ALM
  kReadyLost,      ///< /S-RDY went off
  kNotReady,       ///< /S-RDY did not come
  kEncoderFrozen,  ///< counts stand while the command moves
  kRunaway,        ///< the axis moves against its drive command
  kCountStep,      ///< counts changed faster than the axis can move
  kSaturation,     ///< drive command at +-10 V for too long
  kLatePeriods,    ///< several periods in a row began too late
  kStall,          ///< one period began far too late
  kSamplesLost,    ///< samples came faster than they could be written
  kServoFailed,    ///< the position loops of the caller gave no drive command
  kOutsideTravel,  ///< the next set point lies outside the travel, or is no number
};

/// What is done about it.
enum class Reaction : std::uint8_t {
  kImmediate,   ///< 0 V and servo off in the same period's write
  kControlled,  ///< brake on the path; the loop still works
};

inline constexpr std::size_t kNoAxis = 2;  ///< a trip that is not about one axis
inline constexpr std::size_t kAxisZ = 3;   ///< the third axis, which has no servo

/// What is done about a kind.
Reaction reaction_to(Kind kind) noexcept;

/// Why a motion was ended by a monitor. Plain data, made in the cycle.
struct Trip {
  Kind kind = Kind::kTrackingError;
  std::size_t axis = kNoAxis;  ///< hal::kX, hal::kY or kNoAxis
  double value = 0.0;          ///< found [mm], [s] or a number, as its kind has it
  double limit = 0.0;          ///< the same unit; nothing for the kinds that are a switch
  double time = 0.0;           ///< since the first set point [s]
  std::int64_t line = 0;       ///< NC line; 0 before the first set point
};

/// Whether the machine is switched off at once.
inline bool is_immediate(const Trip& trip) noexcept {
  return reaction_to(trip.kind) == Reaction::kImmediate;
}

/// One line that tells a person of a trip: axis, value with unit, limit, time, NC line, what was
/// done and what to do. Not real-time safe.
/// @param advice_instead  what to do, where more is known of the trip than its kind
std::string describe(const Trip& trip, const std::string& advice_instead = {});

}  // namespace twin::motion
