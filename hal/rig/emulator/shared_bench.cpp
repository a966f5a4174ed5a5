#include "hal/rig/emulator/shared_bench.hpp"

namespace twin::hal::rig {

Expected<void> SharedBench::power_on(double /*period*/) {
  if (shared_->block().has_ended.load()) {
    return fail(ErrorCode::kMachine, "the emulator of the rig has ended");
  }
  return {};
}

Truth SharedBench::truth() const noexcept {
  Truth truth;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    truth.table_position[axis] = shared_->block().table_position[axis].load();
  }
  return truth;
}

void SharedBench::set_pen_reference(double z) noexcept {
  shared_->block().pen_reference.store(z, std::memory_order_relaxed);
}

}  // namespace twin::hal::rig
