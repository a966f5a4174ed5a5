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

}  // namespace

void power_on(BoardRegisters& boards, int pci1716_board_id, int pci1784_board_id) noexcept {
  power_on(boards.pci1716, pci1716_board_id);
  power_on(boards.pci1784, pci1784_board_id);
}

}  // namespace twin::hal::rig::boards
