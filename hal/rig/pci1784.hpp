#pragma once

#include <array>
#include <cstdint>

#include "hal/rig/cards.hpp"
#include "hal/rig/io_port/io_port.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig {

/// Advantech PCI-1784: four 32 bit quadrature counters, read together.
///
/// Register map (BAR 2) as in Advantech's driver of 2006; mode and clock words as in a program that
/// ran [PRECITEC]. Registers are 32 bits wide. One write to the latch register freezes all four
/// counters, so that their values belong to one instant. The card has no preset: zero is where the
/// counters stood at open(), kept in software.
///
/// A counter c_k runs modulo 2^32; its path in 64 bits is
///   p_k = p_{k-1} + int32(c_k - c_{k-1}),
/// which is right as long as it moves by less than 2^31 counts between two reads.
class Pci1784 {
 public:
  /// Touches nothing. The port must outlive this.
  Pci1784(io_port::IoPort& port, const RigSettings& settings) noexcept;

  /// Modes, interrupts off, clock, reset where wanted; the present counts become 0. Real-time safe.
  void open() noexcept;

  /// Latches all counters and reads them. Real-time safe.
  /// @param counts  unwrapped, since open() [counts]
  /// @returns false if the card no longer answers: all counters and the board ID read all ones
  bool read(std::array<std::int64_t, kCounters>& counts) noexcept;
  /// Which counters have met their index since the last call, bit i for counter i; clears what it
  /// has seen. 0 where the settings say not to look. Real-time safe.
  std::uint8_t take_index() noexcept;
  /// Digital inputs 0 to 3. Real-time safe.
  std::uint8_t digital_in() noexcept;
  /// Board ID switch, 0 to 15; -1 if the card does not answer. Real-time safe.
  int board_id() noexcept;

 private:
  using Raw = std::array<std::uint32_t, kCounters>;
  Raw latch() noexcept;

  io_port::IoPort& port_;
  std::uint32_t mode_;
  std::uint32_t clock_control_;
  std::uint32_t reset_offset_;  // 0: no reset
  bool reads_index_;
  Raw last_{};
  std::array<std::int64_t, kCounters> path_{};  // [counts]
};

}  // namespace twin::hal::rig
