#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace twin::hal::rig::emulator {

/// What can break between the cards and the table, or at the cards. Each stays broken.
enum class FaultKind : std::uint8_t {
  kEncoderFrozen,      ///< no edge arrives at the counter any more
  kEncoderLostCounts,  ///< kLostCounts edges at once never arrive: the counter is off by as many
  kEncoderSlipping,    ///< every fourth edge never arrives
  kEncoderSwapped,     ///< A and B change places: the counter runs the other way
  kDacStuck,           ///< V-REF keeps the voltage of this instant
  kVrefReversed,       ///< V-REF changes its sign
  kVrefOpen,           ///< the wire of V-REF is off: 0 V
  kServoOnLost,        ///< the wire of /S-ON is off
  kAlarm,              ///< the drive gives alarm, once; a reset clears it
  kWireBroken,         ///< the wire of ALM is off: alarm to the controller, the drive runs on
  kLimitPositive,      ///< P-OT opens
  kLimitNegative,      ///< N-OT opens
  kCardGone1716,       ///< all reads ones; without power: V-REF 0 V, digital outputs low
  kCardGone1784,       ///< all reads ones
};

inline constexpr std::size_t kFaultKinds = 14;
inline constexpr std::int64_t kLostCounts = 200;  ///< edges lost by kEncoderLostCounts

/// Name in text, as "encoder_frozen".
std::string_view to_string(FaultKind kind) noexcept;
/// True: it breaks one axis; false: a card.
bool has_axis(FaultKind kind) noexcept;

/// One fault, at its time.
struct Fault {
  FaultKind kind = FaultKind::kEncoderFrozen;
  std::size_t axis = 0;  ///< kX or kY, where the kind has an axis
  /// Since a servo, that of the axis if the kind has one, first became ready [s]. A run moves 0.3 s
  /// after it has switched the servos on.
  double time = 0.0;
};

/// Reads "KIND:AXIS@SECONDS" or "KIND@SECONDS", as "alarm:x@1.5" or "card_gone_1784@2".
/// kUsage error naming what was found and the kinds there are.
Expected<Fault> parse_fault(std::string_view text);
/// The text that parse_fault() reads.
std::string to_string(const Fault& fault);

}  // namespace twin::hal::rig::emulator
