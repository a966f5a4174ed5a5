#include "hal/rig/boards/quadrature_inputs.hpp"

#include <algorithm>
#include <cmath>

namespace twin::hal::rig::boards {
namespace {

// Bits of the interrupt status; counter i has bit + i.
constexpr int kOverflow = 0;
constexpr int kUnderflow = 4;
constexpr int kIndex = 8;
constexpr int kOverCompare = 16;
constexpr int kUnderCompare = 20;

constexpr std::int64_t kModulus = std::int64_t{1} << 32;

/// Largest rate of edges that passes the digital filter [1/s].
double filter_clock(std::uint32_t clock_control) noexcept {
  return 8e6 / static_cast<double>(1U << (clock_control >> 24 & 0x3));
}

/// Edges per count as a power of two; -1: does not count.
int edges_per_count_log2(std::uint32_t mode) noexcept {
  switch (mode & 0x7) {
    case 1:
      return 2;
    case 2:
      return 1;
    case 3:
      return 0;
    default:
      return -1;
  }
}

}  // namespace

std::int64_t QuadratureInputs::filter(std::int64_t edges, double duration) noexcept {
  const double most = std::floor(filter_clock(card_.clock_control.load()) * duration);
  const auto limit = static_cast<std::int64_t>(most);
  const std::int64_t passed = std::clamp(edges, -limit, limit);
  lost_ += static_cast<std::uint64_t>(std::abs(edges - passed));
  return passed;
}

void QuadratureInputs::report(std::size_t counter, std::uint32_t before,
                              std::int64_t change) noexcept {
  const std::int64_t from = before;
  const std::int64_t to = from + change;
  const std::int64_t compare = card_.compare[counter].load();
  const auto bit = [counter](int first) { return 1U << (first + static_cast<int>(counter)); };
  std::uint32_t events = 0;
  events |= to >= kModulus ? bit(kOverflow) : 0;
  events |= to < 0 ? bit(kUnderflow) : 0;
  events |= from <= compare && to > compare ? bit(kOverCompare) : 0;
  events |= from >= compare && to < compare ? bit(kUnderCompare) : 0;
  if (events != 0) {
    card_.interrupt_status.fetch_or(events);
  }
}

void QuadratureInputs::move(const std::array<EncoderMotion, 4>& motions, double duration) noexcept {
  CounterValues running = running_counters(card_);
  const CounterValues before = running;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const int shift = edges_per_count_log2(card_.mode[i].load());
    const std::int64_t last = edges_[i];
    edges_[i] += filter(motions[i].edges, duration);
    if (shift < 0) {
      continue;
    }
    const std::int64_t change = (edges_[i] >> shift) - (last >> shift);
    report(i, before[i] - card_.base[i].load(), change);
    running[i] += static_cast<std::uint32_t>(change);
    if (motions[i].has_index) {
      card_.interrupt_status.fetch_or(1U << (kIndex + static_cast<int>(i)));
      if ((card_.index_reset.load() >> i & 1) != 0) {
        const std::int64_t at_index = (edges_[i] - motions[i].since_index) >> shift;
        const std::int64_t since = (edges_[i] >> shift) - at_index;
        card_.base[i].store(running[i] - static_cast<std::uint32_t>(since));
      }
    }
  }
  set_running_counters(card_, running);
}

}  // namespace twin::hal::rig::boards
