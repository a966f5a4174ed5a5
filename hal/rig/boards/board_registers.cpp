#include "hal/rig/boards/board_registers.hpp"

namespace twin::hal::rig::boards {
namespace {

constexpr std::uint16_t kZeroVolts = 0x8000;  // offset binary

template <class T, std::size_t n>
void clear(std::array<std::atomic<T>, n>& values) noexcept {
  for (std::atomic<T>& value : values) {
    value.store(T{});
  }
}

void power_on(Pci1716Registers& card, int board_id) noexcept {
  for (std::atomic<std::uint16_t>& code : card.dac) {
    code.store(kZeroVolts);
  }
  for (std::atomic<std::uint16_t>* word :
       {&card.dac_range, &card.digital_out, &card.digital_in, &card.ad_mux, &card.control}) {
    word->store(0);
  }
  clear(card.ad_gain);
  clear(card.analogue_in);
  card.ad_next.store(0);
  card.ad_tail.store(card.ad_head.load());
  card.board_id.store(static_cast<std::uint8_t>(board_id));
  card.is_present.store(true);
}

void power_on(Pci1784Registers& card, int board_id) noexcept {
  for (auto* words :
       {&card.mode, &card.running[0], &card.running[1], &card.base, &card.latched, &card.compare}) {
    clear(*words);
  }
  card.sequence.store(0);
  for (std::atomic<std::uint32_t>* word :
       {&card.interrupt_enable, &card.interrupt_status, &card.clock_control, &card.digital_out}) {
    word->store(0);
  }
  card.digital_mode.store(0);
  card.digital_in.store(0);
  card.index_reset.store(0);
  card.board_id.store(static_cast<std::uint8_t>(board_id));
  card.is_present.store(true);
}

// A try fails only when a change begins during its few loads.
constexpr int kMostReads = 10'000;

void store(std::array<std::atomic<std::uint32_t>, 4>& copy, const CounterValues& values) noexcept {
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Who sees this value sees the sequence that was stored before it.
    copy[i].store(values[i], std::memory_order_release);
  }
}

}  // namespace

void power_on(BoardRegisters& boards, int pci1716_board_id, int pci1784_board_id) noexcept {
  power_on(boards.pci1716, pci1716_board_id);
  power_on(boards.pci1784, pci1784_board_id);
}

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
