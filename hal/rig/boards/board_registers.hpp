#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

/// What is inside the emulated boards. The registers are plain atomics, so that they can lie in
/// memory that two processes share, and so that a process that is killed in the middle of an access
/// blocks nobody.
namespace twin::hal::rig::boards {

inline constexpr std::uint32_t kAdFifoSize = 1024;  ///< samples the A/D FIFO holds

/// PCI-1716. The card's side (IoPort) and the wires' side (drives) meet here.
struct Pci1716Registers {
  std::array<std::atomic<std::uint16_t>, 2> dac{};  ///< code of each converter
  std::atomic<std::uint16_t> dac_range{0};  ///< range word: channel 0 in bits 2:0, 1 in 10:8
  std::atomic<std::uint16_t> digital_out{0};
  std::atomic<std::uint16_t> digital_in{0};
  std::atomic<std::uint16_t> ad_mux{0};  ///< start channel in the low byte, stop in the high one
  std::atomic<std::uint8_t> ad_next{0};  ///< channel of the next trigger
  std::atomic<std::uint16_t> control{0};
  std::array<std::atomic<std::uint16_t>, 16> ad_gain{};           ///< range code of each channel
  std::array<std::atomic<std::uint16_t>, kAdFifoSize> ad_fifo{};  ///< converted, not yet read
  std::atomic<std::uint32_t> ad_head{0};                          ///< values ever put in
  std::atomic<std::uint32_t> ad_tail{0};                          ///< values ever taken out
  std::array<std::atomic<float>, 16> analogue_in{};               ///< at the analogue inputs [V]
  std::atomic<std::uint8_t> board_id{0};
  std::atomic<bool> is_present{true};  ///< false: every read is all ones, writes go nowhere
};

/// PCI-1784. A counter shows what has run at its inputs less its base, modulo 2^32; a reset moves
/// the base. So the wires' side alone changes what runs and the card's side needs no lock.
///
/// What runs is kept twice. A reader takes copy number `sequence & 1` and tries again if the
/// sequence has changed meanwhile; the writer makes the sequence odd, changes copy 0, makes it
/// even, changes copy 1. The copy a reader takes is whole at every instant, also if the writer is
/// killed.
struct Pci1784Registers {
  std::array<std::atomic<std::uint32_t>, 4> mode{};
  std::array<std::array<std::atomic<std::uint32_t>, 4>, 2> running{};
  std::atomic<std::uint32_t> sequence{0};
  std::array<std::atomic<std::uint32_t>, 4> base{};
  std::array<std::atomic<std::uint32_t>, 4> latched{};  ///< what a read shows
  std::array<std::atomic<std::uint32_t>, 4> compare{};
  std::atomic<std::uint32_t> interrupt_enable{0};
  std::atomic<std::uint32_t> interrupt_status{0};
  std::atomic<std::uint32_t> clock_control{0};
  std::atomic<std::uint32_t> digital_out{0};
  std::atomic<std::uint16_t> digital_mode{0};
  std::atomic<std::uint8_t> digital_in{0};
  std::atomic<std::uint8_t> index_reset{0};  ///< bit i: the index sets counter i to 0
  std::atomic<std::uint8_t> board_id{0};
  std::atomic<bool> is_present{true};
};

/// Both cards.
struct BoardRegisters {
  Pci1716Registers pci1716;
  Pci1784Registers pci1784;
};

/// Switches the cards on: all registers 0, both converters at the code of 0 V, cards present, A/D
/// inputs at 0 V. Not for cards in use.
void power_on(BoardRegisters& boards, int pci1716_board_id, int pci1784_board_id) noexcept;

/// What has run at the inputs of the four counters [counts modulo 2^32].
using CounterValues = std::array<std::uint32_t, 4>;

/// Returns all four as they were at one instant. It ends also if the wires' side was killed in the
/// middle of a change, and after a bounded number of tries in any case. Real-time safe.
CounterValues running_counters(const Pci1784Registers& card) noexcept;

/// Changes all four at one instant; for the wires' side, which is one thread. Real-time safe.
void set_running_counters(Pci1784Registers& card, const CounterValues& values) noexcept;

/// What a register that has nothing to show reads as. The value is neither 0 nor all ones; it
/// differs from offset to offset and is always the same there. Real-time safe.
constexpr std::uint16_t junk(std::uint32_t offset) noexcept {
  return static_cast<std::uint16_t>(0x5AC3U ^ (offset * 0x0107U));
}

/// The same, 32 bits. Real-time safe.
constexpr std::uint32_t junk32(std::uint32_t offset) noexcept {
  return 0x6E000000U ^ (offset * 0x00010000U) ^ junk(offset);
}

}  // namespace twin::hal::rig::boards
