#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "hal/rig/io_port/pci_device.hpp"
#include "hal/rig/io_port/port_address.hpp"

namespace twin::hal::rig::io_port {

/// A kind of card and the register that shows its board ID switch in bits 3:0.
struct CardKind {
  std::string_view name;
  std::uint16_t vendor;
  std::uint16_t device;
  std::uint32_t board_id_offset;
  int board_id_bits;  ///< width of that register, 16 or 32
};

inline constexpr CardKind kPci1716{"PCI-1716", 0x13FE, 0x1716, 0x14, 16};
inline constexpr CardKind kPci1784{"PCI-1784", 0x13FE, 0x1784, 0x28, 32};

inline constexpr int kRegisterBar = 2;  ///< BAR with the card's registers, of both kinds

/// One card that was looked at.
struct CardSeen {
  PciDevice pci;
  PortAddress port;   ///< where its registers are, if `board_id` is known
  int board_id = -1;  ///< its switch, 0 to 15; -1: could not be read
  std::string why;    ///< why it cannot be used; empty if it can
};

/// All cards of a kind under a sysfs root, each with its board ID or the reason why it has none.
///
/// A card with a kernel driver bound is not touched. A card that is switched off is switched on,
/// for else it shows no board ID; nothing is written to its registers.
std::vector<CardSeen> look_for_cards(const CardKind& kind, Access access,
                                     const std::string& sysfs = "/sys");

/// The one card of a kind with a board ID.
///
/// @returns a kMachine error of one line that names what was looked for, what is there instead and
/// what to do
Expected<CardSeen> find_card(const CardKind& kind, int board_id, Access access,
                             const std::string& sysfs = "/sys");

}  // namespace twin::hal::rig::io_port
