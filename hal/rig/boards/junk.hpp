#pragma once

#include <cstdint>

namespace twin::hal::rig::boards {

/// What an emulated register shows that has nothing to show: neither 0 nor all ones, another value
/// at every offset, always the same there. Real-time safe.
constexpr std::uint16_t junk(std::uint32_t offset) noexcept {
  return static_cast<std::uint16_t>(0x5AC3U ^ (offset * 0x0107U));
}

/// The same, 32 bits. Real-time safe.
constexpr std::uint32_t junk32(std::uint32_t offset) noexcept {
  return 0x6E000000U ^ (offset * 0x00010000U) ^ junk(offset);
}

}  // namespace twin::hal::rig::boards
