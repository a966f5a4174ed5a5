#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "hal/rig/boards/board_registers.hpp"
#include "hal/rig/boards/emulated_board.hpp"

namespace twin::hal::rig::boards {

/// Offsets of the PCI-1784 that no source confirms.
struct Pci1784Layout {
  std::uint32_t reset = 0x2C;    ///< resets of the counters, enables of the index resets
  std::uint32_t compare = 0x10;  ///< compare value of counter 0; the others follow
};

/// BAR2 of a PCI-1784, 64 bytes, over emulated registers.
///
/// The offsets 0x00 to 0x0C are the modes when written and the latched counters when read. Writing
/// 0x28 latches, at one instant, the counters whose bits are set and whose mode has bit 8. Reading
/// 0x24 clears the interrupt status. Events are kept in the status whether enabled or not; bit 31
/// is set while an enabled one is among them. Registers are dwords, but for the word at 0x32.
class EmulatedPci1784 final : public EmulatedBoard {
 public:
  /// @param owner  of the registers, kept as long as this; null: they live longer by themselves
  explicit EmulatedPci1784(Pci1784Registers& registers, Pci1784Layout layout = {},
                           std::shared_ptr<const void> owner = nullptr) noexcept
      : EmulatedBoard(registers.is_present, std::move(owner)), card_(registers), layout_(layout) {}

  std::uint32_t read32(std::uint32_t offset) noexcept override;
  void write16(std::uint32_t offset, std::uint16_t value) noexcept override;
  void write32(std::uint32_t offset, std::uint32_t value) noexcept override;

 private:
  std::uint32_t status() const noexcept;
  void latch(std::uint32_t counters) noexcept;
  void reset(std::uint32_t value) noexcept;

  Pci1784Registers& card_;
  Pci1784Layout layout_;
};

}  // namespace twin::hal::rig::boards
