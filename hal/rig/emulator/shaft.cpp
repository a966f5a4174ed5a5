#include "hal/rig/emulator/shaft.hpp"

#include <cmath>

namespace twin::hal::rig::emulator {

Shaft::Shaft(const mujoco::AxisParams& axis, double position) noexcept
    : encoder_(axis.encoder), lead_(axis.screw.lead), origin_(position) {
  encoder_.zero(position);
  counts_ = encoder_.counts(position);
}

std::int64_t Shaft::turn(double position) const noexcept {
  return static_cast<std::int64_t>(std::floor((position - origin_) / lead_ + 0.5));
}

boards::EncoderMotion Shaft::move_to(double position) noexcept {
  boards::EncoderMotion motion;
  const std::int64_t counts = encoder_.counts(position);
  const std::int64_t turn_now = turn(position);
  motion.edges = counts - counts_;
  motion.has_index = turn_now != turn_;
  if (motion.has_index) {
    const double half = turn_now > turn_ ? -0.5 : 0.5;
    const double index = origin_ + lead_ * (static_cast<double>(turn_now) + half);
    motion.since_index = counts - encoder_.counts(index);
  }
  counts_ = counts;
  turn_ = turn_now;
  return motion;
}

}  // namespace twin::hal::rig::emulator
