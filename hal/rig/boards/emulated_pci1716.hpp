#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "hal/rig/boards/board_registers.hpp"
#include "hal/rig/boards/emulated_board.hpp"

namespace twin::hal::rig::boards {

/// BAR2 of a PCI-1716, 32 bytes, over emulated registers.
///
/// A register that can only be written reads as junk, as do the bits that a register does not have.
/// Registers are words; bytes are the clears at 0x08 and 0x09 and nothing else. The
/// A/D converts at once on the software trigger, one channel of the scan per trigger. The 8254 is
/// not emulated.
class EmulatedPci1716 final : public EmulatedBoard {
 public:
  /// @param owner  of the registers, kept as long as this; null: they live longer by themselves
  explicit EmulatedPci1716(Pci1716Registers& registers,
                           std::shared_ptr<const void> owner = nullptr) noexcept
      : EmulatedBoard(registers.is_present, std::move(owner)), card_(registers) {}

  std::uint16_t read16(std::uint32_t offset) noexcept override;
  void write8(std::uint32_t offset, std::uint8_t value) noexcept override;
  void write16(std::uint32_t offset, std::uint16_t value) noexcept override;

 private:
  std::uint16_t status() const noexcept;
  std::uint16_t take_sample() noexcept;
  void set_gain(std::uint16_t value) noexcept;
  void set_mux(std::uint16_t value) noexcept;
  void trigger() noexcept;
  void clear_fifo() noexcept;

  Pci1716Registers& card_;
};

}  // namespace twin::hal::rig::boards
