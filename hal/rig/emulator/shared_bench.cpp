#include "hal/rig/emulator/shared_bench.hpp"

#include <time.h>

#include "core/wall_clock.hpp"

namespace twin::hal::rig::emulator {

Expected<void> SharedBench::power_on(double /*period*/) {
  if (shared_->block().has_ended.load()) {
    return fail(ErrorCode::kMachine, "the emulator of the rig has ended");
  }
  return {};
}

bool SharedBench::advance() noexcept {
  constexpr std::int64_t kUsualLag = 1'000'000;  // [ns]; steps are shorter
  constexpr timespec kNap{0, 20'000};
  const std::atomic<std::int64_t>& passed = shared_->block().monotonic_ns;
  const std::int64_t now = monotonic_ns();
  while (passed.load(std::memory_order_acquire) < now - kUsualLag) {
    if (passed.load() == given_up_at_) {
      return true;  // it stands: what a dead plant does is for the monitors to see
    }
    if (monotonic_ns() - now > kLongestWait) {
      given_up_at_ = passed.load();
      return true;
    }
    ::nanosleep(&kNap, nullptr);
  }
  given_up_at_ = -1;
  return true;
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

}  // namespace twin::hal::rig::emulator
