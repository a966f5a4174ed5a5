#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace twin::hal::mujoco {

/// What of a simulated axis may change while it runs.
enum class ChangeKind : std::uint8_t {
  kFriction,     ///< all friction of the slide, as a factor
  kStiffness,    ///< stiffness of the screw, as a factor; screws that give only
  kVrefGain,     ///< speed per volt of V-REF, as a factor
  kVrefOffset,   ///< added to V-REF [mV]
  kLoopGain,     ///< gain of the velocity loop, as a factor
  kEncoderSlip,  ///< so many of 1,000 edges are lost
  kBacklash,     ///< added play between screw and slide [um]; screws that give only
  kLoad,         ///< mass on the slide [kg]
  kForce,        ///< force on the slide, towards plus [N]
};

inline constexpr std::size_t kChangeKinds = 9;

/// Name in text, as "vref_gain".
std::string_view to_string(ChangeKind kind) noexcept;

/// Something of an axis changes, at once or slowly.
struct Change {
  ChangeKind kind = ChangeKind::kFriction;
  std::size_t axis = 0;  ///< kX or kY
  double value = 1.0;    ///< in the end, in the unit of its kind
  double start = 0.0;    ///< since the drive of the axis first became ready [s]
  double ramp = 0.0;     ///< time from the start until the value is reached, 0: at once [s]
};

/// What an axis is like in a physics step, against its parameters.
struct AxisCondition {
  double friction = 1.0;     ///< factor
  double stiffness = 1.0;    ///< factor
  double vref_gain = 1.0;    ///< factor
  double vref_offset = 0.0;  ///< added [V]
  double loop_gain = 1.0;    ///< factor
  double lost_share = 0.0;   ///< of the encoder's edges [-]
  double backlash = 0.0;     ///< added [mm]
  double mass = 0.0;         ///< added [kg]
  double force = 0.0;        ///< added [N]
};

/// Reads "KIND:AXIS=VALUE@SECONDS", or with "+RAMP" behind it, as "friction:x=1.3@2" or
/// "vref_gain:y=0.95@1+5".
/// @returns kUsage error naming what was found and the kinds there are
Expected<Change> parse_change(std::string_view text);
/// The text that parse_change() reads.
std::string to_string(const Change& change);

/// Whether a change needs a screw that gives.
bool needs_screw(ChangeKind kind) noexcept;

/// The condition of an axis at a time.
/// @param time  since its drive first became ready [s]
AxisCondition condition_at(const std::vector<Change>& changes, std::size_t axis,
                           double time) noexcept;

}  // namespace twin::hal::mujoco
