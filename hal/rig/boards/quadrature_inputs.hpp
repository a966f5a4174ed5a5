#pragma once

#include <array>
#include <cstdint>

#include "hal/rig/boards/board_registers.hpp"

namespace twin::hal::rig::boards {

/// What the wires of one encoder did in a while.
struct EncoderMotion {
  std::int64_t edges = 0;        ///< edges of A and B, positive where B leads A
  bool has_index = false;        ///< the index was met
  std::int64_t since_index = 0;  ///< edges from the index to where the encoder stands now
};

/// The wires' side of a PCI-1784: edges of four encoders run into its counters.
///
/// With q edges of A and B so far a counter has run to q at x4 (mode bits 2:0 = 3), floor(q / 2) at
/// x2 (2) and floor(q / 4) at x1 (1); in other modes it stands. The digital filter passes no more
/// edges than the filter clock f, 8, 4, 2 or 1 MHz for bits 25:24 of the clock word = 0 to 3, so
/// that phases A and B up to f / 4 are counted; what comes faster is lost.
///
/// Overflow is a step over 2^32 - 1 upwards, underflow one below 0 downwards; over and under
/// compare are steps across the compare value.
class QuadratureInputs {
 public:
  /// @param card that lives longer than this
  explicit QuadratureInputs(Pci1784Registers& card) noexcept : card_(card) {}

  /// All four encoders moved. Real-time safe. @param duration of the motion [s]
  void move(const std::array<EncoderMotion, 4>& motions, double duration) noexcept;

  /// Edges that the filter has swallowed so far.
  std::uint64_t lost_edges() const noexcept { return lost_; }

 private:
  std::int64_t filter(std::int64_t edges, double duration) noexcept;
  void report(std::size_t counter, std::uint32_t before, std::int64_t change) noexcept;

  Pci1784Registers& card_;
  std::array<std::int64_t, 4> edges_{};  // q, behind the filter
  std::uint64_t lost_ = 0;
};

}  // namespace twin::hal::rig::boards
