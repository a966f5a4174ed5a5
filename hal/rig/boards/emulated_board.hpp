#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

#include "hal/rig/io_port/io_port.hpp"

namespace twin::hal::rig::boards {

/// What both emulated boards do with an access that no register takes: it reads as all ones, writes
/// nothing and is counted. A board takes an access by overriding the function of its width.
class EmulatedBoard : public io_port::IoPort {
 public:
  std::uint8_t read8(std::uint32_t /*offset*/) noexcept override {
    refuse();
    return 0xFF;
  }
  std::uint16_t read16(std::uint32_t /*offset*/) noexcept override {
    refuse();
    return 0xFFFF;
  }
  std::uint32_t read32(std::uint32_t /*offset*/) noexcept override {
    refuse();
    return 0xFFFFFFFF;
  }
  void write8(std::uint32_t /*offset*/, std::uint8_t /*value*/) noexcept override { refuse(); }
  void write16(std::uint32_t /*offset*/, std::uint16_t /*value*/) noexcept override { refuse(); }
  void write32(std::uint32_t /*offset*/, std::uint32_t /*value*/) noexcept override { refuse(); }

  /// Emulated registers can always be reached.
  int error() const noexcept override { return 0; }
  /// Accesses that no register takes.
  int rejected() const noexcept { return rejected_; }

 protected:
  /// @param is_present  false: every read is all ones, and writes go nowhere
  /// @param owner       of the registers, kept as long as this; null: they live longer anyway
  EmulatedBoard(const std::atomic<bool>& is_present, std::shared_ptr<const void> owner) noexcept
      : owner_(std::move(owner)), is_present_(is_present) {}

  bool is_present() const noexcept { return is_present_.load(std::memory_order_acquire); }
  /// Counts an access, where the board is there to see it.
  void refuse() noexcept { rejected_ += is_present() ? 1 : 0; }
  /// True if the board is there and has a register of this width at this offset; else the access is
  /// refused.
  bool takes(std::uint32_t offset, std::uint32_t width, std::uint32_t end) noexcept {
    const bool is_register = offset % width == 0 && offset < end;
    if (!is_register) {
      refuse();
    }
    return is_register && is_present();
  }

 private:
  std::shared_ptr<const void> owner_;
  const std::atomic<bool>& is_present_;
  int rejected_ = 0;
};

}  // namespace twin::hal::rig::boards
