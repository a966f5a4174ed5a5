#pragma once

#include <array>
#include <cstdint>

#include "hal/rig/boards/board_registers.hpp"

namespace twin::hal::rig::boards {

/// What has run at the inputs of the four counters [counts modulo 2^32].
using CounterValues = std::array<std::uint32_t, 4>;

/// All four of one instant. Ends also if the wires' side was killed in the middle of a change, and
/// after a bounded number of tries in any case. Real-time safe.
CounterValues running_counters(const Pci1784Registers& card) noexcept;

/// Changes all four at one instant; for the wires' side, which is one thread. Real-time safe.
void set_running_counters(Pci1784Registers& card, const CounterValues& values) noexcept;

}  // namespace twin::hal::rig::boards
