#include "hal/rig/io_port/find_card.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace twin::hal::rig::io_port {
namespace {

constexpr std::uint16_t kSubsystem1716L = 0x0001;  // the variant without analogue outputs

Expected<PortAddress> address_of(const PciDevice& device, Access access) {
  return io_base(device, kRegisterBar).map([&](std::uint32_t base) {
    return access == Access::kSysfs
               ? PortAddress{access, fmt::format("{}/resource{}", device.folder, kRegisterBar), 0}
               : PortAddress{access, {}, base};
  });
}

// All ones is what a card that does not answer shows, whatever its switch.
Expected<int> board_id_of(const CardKind& kind, IoPort& port) {
  const bool is_word = kind.board_id_bits == 16;
  const std::uint32_t raw =
      is_word ? port.read16(kind.board_id_offset) : port.read32(kind.board_id_offset);
  if (port.error() != 0 || raw == (is_word ? 0xFFFFu : 0xFFFFFFFFu)) {
    return fail(ErrorCode::kMachine, "it does not answer: its registers read all ones");
  }
  return static_cast<int>(raw & 0xF);
}

Expected<CardSeen> look_at(const CardKind& kind, const PciDevice& device, Access access) {
  if (!device.driver.empty()) {
    return fail(ErrorCode::kMachine,
                fmt::format("kernel driver {0} has it; unbind it: echo {1} > {2}/driver/unbind",
                            device.driver, device.address, device.folder));
  }
  if (kind.device == kPci1716.device && device.subsystem_device == kSubsystem1716L) {
    return fail(ErrorCode::kMachine, "it is a PCI-1716L, which has no analogue outputs");
  }
  TWIN_TRY(const PortAddress address, address_of(device, access));
  TWIN_CHECK(enable(device));
  TWIN_TRY(const auto port, open_port(address));
  return board_id_of(kind, *port).map([&](int board_id) {
    return CardSeen{.pci = device, .port = address, .board_id = board_id, .why = {}};
  });
}

std::string description(const CardSeen& card) {
  return card.why.empty() ? fmt::format("{} with board ID {}", card.pci.address, card.board_id)
                          : fmt::format("{}: {}", card.pci.address, card.why);
}

std::string what_is_there(const CardKind& kind, const std::vector<CardSeen>& cards,
                          const std::string& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    return ", which is no folder";
  }
  if (cards.empty()) {
    return fmt::format("; there is no {} at all", kind.name);
  }
  std::string text = "; there is";
  for (const CardSeen& card : cards) {
    text += fmt::format("{} {}", &card == &cards.front() ? "" : ",", description(card));
  }
  return text;
}

}  // namespace

std::vector<CardSeen> look_for_cards(const CardKind& kind, Access access,
                                     const std::string& sysfs) {
  std::vector<CardSeen> cards;
  for (const PciDevice& device : pci_devices(sysfs, kind.vendor, kind.device)) {
    CardSeen unusable;
    unusable.pci = device;
    const Expected<CardSeen> card = look_at(kind, device, access);
    if (!card) {
      unusable.why = card.error().message;
    }
    cards.push_back(card.value_or(unusable));
  }
  return cards;
}

Expected<CardSeen> find_card(const CardKind& kind, int board_id, Access access,
                             const std::string& sysfs) {
  const std::vector<CardSeen> cards = look_for_cards(kind, access, sysfs);
  const CardSeen* found = nullptr;
  for (const CardSeen& card : cards) {
    if (card.board_id != board_id) {
      continue;
    }
    if (found != nullptr) {
      return fail(ErrorCode::kMachine,
                  fmt::format("two {} have board ID {}, {} and {}: set their switches apart",
                              kind.name, board_id, found->pci.address, card.pci.address));
    }
    found = &card;
  }
  if (found != nullptr) {
    return *found;
  }
  const std::string folder = pci_folder(sysfs);
  return fail(
      ErrorCode::kMachine,
      fmt::format("no usable {} ({:04x}:{:04x}) with board ID {} under {}{}", kind.name,
                  kind.vendor, kind.device, board_id, folder, what_is_there(kind, cards, folder)));
}

}  // namespace twin::hal::rig::io_port
