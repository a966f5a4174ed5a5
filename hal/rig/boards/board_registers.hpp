#pragma once

#include <array>
#include <atomic>
#include <cstdint>

/// What is inside the emulated boards: plain atomics, so that they can lie in memory that two
/// processes share, and so that a process that is killed in the middle of an access blocks nobody.
namespace twin::hal::rig {

/// PCI-1716. The card's side (IoPort) and the wires' side (drives) meet here.
struct Pci1716Registers {
  std::array<std::atomic<std::uint16_t>, 2> dac{};  ///< code of each converter
  std::atomic<std::uint16_t> dac_range{0};  ///< range word: channel 0 in bits 2:0, 1 in 10:8
  std::atomic<std::uint16_t> digital_out{0};
  std::atomic<std::uint16_t> digital_in{0};
  std::atomic<std::uint16_t> ad_range{0};
  std::atomic<std::uint16_t> ad_mux{0};
  std::atomic<std::uint16_t> control{0};
  std::array<std::atomic<std::uint16_t>, 16> ad_gain{};  ///< range code of each channel
  std::array<std::atomic<std::uint16_t>, 16> ad_fifo{};  ///< converted, not yet read
  std::atomic<std::uint32_t> ad_head{0};                 ///< values ever put in
  std::atomic<std::uint32_t> ad_tail{0};                 ///< values ever taken out
  std::array<std::atomic<float>, 16> analogue_in{};      ///< volts at the analogue inputs
  std::atomic<std::uint8_t> board_id{0};
  std::atomic<bool> is_present{true};  ///< false: every read is all ones, writes go nowhere
};

/// PCI-1784.
struct Pci1784Registers {
  std::array<std::atomic<std::uint32_t>, 4> mode{};
  std::array<std::atomic<std::uint32_t>, 4> live{};     ///< counters as they run
  std::array<std::atomic<std::uint32_t>, 4> latched{};  ///< what a read shows
  std::array<std::atomic<std::uint32_t>, 4> compare{};
  std::atomic<std::uint32_t> sequence{0};  ///< odd while the wires' side changes several counters
  std::atomic<std::uint32_t> resets{0};    ///< bit i: counter i is to be set to 0
  std::atomic<std::uint32_t> interrupt_enable{0};
  std::atomic<std::uint32_t> interrupt_status{0};
  std::atomic<std::uint32_t> clock_control{0};
  std::atomic<std::uint16_t> digital_out{0};
  std::atomic<std::uint8_t> digital_in{0};
  std::atomic<std::uint8_t> index_reset{0};  ///< bit i: the index sets counter i to 0
  std::atomic<std::uint8_t> board_id{0};
  std::atomic<bool> is_present{true};
};

}  // namespace twin::hal::rig
