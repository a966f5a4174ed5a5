#include "shadow/parameter.hpp"

#include <fmt/format.h>

#include <cmath>

namespace twin::shadow {
namespace {

struct CauseFacts {
  std::string_view name;
  std::string_view words;
  std::string_view unit;
  double per_base;  // of the unit
};

// In the order of Cause.
constexpr std::array<CauseFacts, kCauses> kCauseFacts{{
    {"friction", "friction", "%", 100.0},
    {"vref_gain", "gain of V-REF", "%", 100.0},
    {"loop_gain", "gain of the velocity loop", "%", 100.0},
    {"vref_offset", "offset of V-REF", "mV", 1e3},
    {"load", "mass that is moved", "kg", 1.0},
    {"force", "force on the slide", "N", 1.0},
    {"stiffness", "stiffness of the screw", "%", 100.0},
    {"backlash", "backlash", "um", 1e3},
    {"motor_force", "force of the motor for the same motion", "%", 100.0},
    {"encoder", "encoder counts", "counts of 1,000", 1e3},
}};

const CauseFacts& facts_of(Cause cause) noexcept {
  return kCauseFacts[static_cast<std::size_t>(cause)];
}

}  // namespace

std::string_view name_of(Cause cause) noexcept { return facts_of(cause).name; }

std::string_view words_of(Cause cause) noexcept { return facts_of(cause).words; }

std::string amount_of(Cause cause, double change, double deviation) {
  if (cause == Cause::kStiffness || cause == Cause::kLoopGain) {
    // Known by its inverse; the first order is enough for its deviation.
    const double rest = 1.0 + change > 0.05 ? 1.0 / (1.0 + change) : 20.0;
    change = rest - 1.0;
    deviation *= rest * rest;
  }
  const CauseFacts& facts = facts_of(cause);
  return fmt::format("{:+.3g} {} (+- {:.2g})", change * facts.per_base, facts.unit,
                     deviation * facts.per_base);
}

}  // namespace twin::shadow
