#include "hal/rig/boards/running_counters.hpp"

namespace twin::hal::rig::boards {
namespace {

// A try fails only when a change begins during its few loads.
constexpr int kMostReads = 10'000;

void store(std::array<std::atomic<std::uint32_t>, 4>& copy, const CounterValues& values) noexcept {
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Who sees this value sees the sequence that was stored before it.
    copy[i].store(values[i], std::memory_order_release);
  }
}

}  // namespace

CounterValues running_counters(const Pci1784Registers& card) noexcept {
  CounterValues values{};
  for (int i = 0; i < kMostReads; ++i) {
    const std::uint32_t before = card.sequence.load(std::memory_order_acquire);
    for (std::size_t c = 0; c < values.size(); ++c) {
      values[c] = card.running[before & 1][c].load(std::memory_order_acquire);
    }
    if (card.sequence.load(std::memory_order_acquire) == before) {
      return values;
    }
  }
  return values;
}

void set_running_counters(Pci1784Registers& card, const CounterValues& values) noexcept {
  const std::uint32_t even = card.sequence.load(std::memory_order_relaxed) & ~1U;
  card.sequence.store(even + 1, std::memory_order_release);
  store(card.running[0], values);
  card.sequence.store(even + 2, std::memory_order_release);
  store(card.running[1], values);
}

}  // namespace twin::hal::rig::boards
