#include "hal/mujoco/encoder.hpp"

namespace twin::hal::mujoco {

std::int64_t Encoder::counts(double position) const noexcept {
  return static_cast<std::int64_t>(std::floor((position - origin_) / mm_per_count_ + phase_));
}

}  // namespace twin::hal::mujoco
