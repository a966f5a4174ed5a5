#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace twin::shadow {

/// What may have changed of an axis. All but the last are parameters of its model.
enum class Cause : std::uint8_t {
  kFriction,    ///< all friction of the slide, relative
  kVrefGain,    ///< speed per volt of V-REF, relative; in torque mode force per volt
  kLoopGain,    ///< inverse of the gain of the velocity loop, relative
  kOffset,      ///< of V-REF [V]
  kInertia,     ///< mass that is moved [kg]
  kForce,       ///< constant force on the slide, towards plus [N]
  kStiffness,   ///< compliance of the screw, relative
  kBacklash,    ///< play between screw and slide [mm]
  kMotorForce,  ///< force of the motor for the same motion, relative
  kEncoder,     ///< encoder counts lost or slipping, of all that pass
};

inline constexpr std::size_t kParameters = 9;  ///< causes that are parameters of the model
inline constexpr std::size_t kCauses = 10;

/// A value for each parameter, in the unit of its cause.
using PerParameter = std::array<double, kParameters>;

/// Name in files, as "vref_gain".
std::string_view name_of(Cause cause) noexcept;
/// Name in words, as "gain of V-REF".
std::string_view words_of(Cause cause) noexcept;
/// A change with its standard deviation in words, as "+31 % (+- 3 %)".
std::string amount_of(Cause cause, double change, double deviation);

}  // namespace twin::shadow
