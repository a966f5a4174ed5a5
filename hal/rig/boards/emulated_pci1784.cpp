#include "hal/rig/boards/emulated_pci1784.hpp"

namespace twin::hal::rig::boards {
namespace {

// Offsets in BAR2.
constexpr std::uint32_t kCountersEnd = 0x10;  // modes when written, latched values when read
constexpr std::uint32_t kInterrupt = 0x20;    // enables when written, status when read
constexpr std::uint32_t kClock = 0x24;        // read: clears the status
constexpr std::uint32_t kLatch = 0x28;        // read: board ID
constexpr std::uint32_t kDigitalIn = 0x30;
constexpr std::uint32_t kDigitalMode = 0x32;  // a word
constexpr std::uint32_t kPci1784Bytes = 0x40;

constexpr std::uint32_t kSoftwareLatch = 0x100;  // of the mode
constexpr std::uint32_t kMaster = 0x80000000;    // of the interrupt registers
constexpr std::uint32_t kAllOnes32 = 0xFFFFFFFF;

}  // namespace

std::uint32_t EmulatedPci1784::status() const noexcept {
  const std::uint32_t events = card_.interrupt_status.load();
  const std::uint32_t enabled = card_.interrupt_enable.load();
  const bool is_pending = (enabled & kMaster) != 0 && (events & enabled & ~kMaster) != 0;
  return events | (is_pending ? kMaster : 0);
}

void EmulatedPci1784::latch(std::uint32_t counters) noexcept {
  const CounterValues now = running_counters(card_);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if ((counters >> i & 1) != 0 && (card_.mode[i].load() & kSoftwareLatch) != 0) {
      card_.latched[i].store(now[i] - card_.base[i].load(), std::memory_order_release);
    }
  }
}

void EmulatedPci1784::reset(std::uint32_t value) noexcept {
  const CounterValues now = running_counters(card_);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if ((value >> i & 1) != 0) {
      card_.base[i].store(now[i]);
    }
  }
  card_.index_reset.store(static_cast<std::uint8_t>(value >> 4 & 0xF));
}

std::uint32_t EmulatedPci1784::read32(std::uint32_t offset) noexcept {
  if (!takes(offset, 4, kPci1784Bytes)) {
    return kAllOnes32;
  }
  if (offset < kCountersEnd) {
    return card_.latched[offset / 4].load(std::memory_order_acquire);
  }
  switch (offset) {
    case kInterrupt:
      return status();
    case kClock:
      card_.interrupt_status.store(0);
      return junk32(offset);
    case kLatch:
      return (junk32(offset) & ~0xFU) | (card_.board_id.load() & 0xFU);
    case kDigitalIn:
      return (junk32(offset) & ~0xF0U) | (card_.digital_in.load() & 0xFU) << 4;
    default:
      return junk32(offset);
  }
}

void EmulatedPci1784::write32(std::uint32_t offset, std::uint32_t value) noexcept {
  if (!takes(offset, 4, kPci1784Bytes)) {
    return;
  }
  if (offset == layout_.reset) {
    return reset(value);
  }
  if (offset < kCountersEnd) {
    return card_.mode[offset / 4].store(value);
  }
  if (offset >= layout_.compare && offset < layout_.compare + 16) {
    return card_.compare[(offset - layout_.compare) / 4].store(value);
  }
  switch (offset) {
    case kInterrupt:
      return card_.interrupt_enable.store(value);
    case kClock:
      return card_.clock_control.store(value);
    case kLatch:
      return latch(value);
    case kDigitalIn:
      return card_.digital_out.store(value);
    default:
      return;
  }
}

void EmulatedPci1784::write16(std::uint32_t offset, std::uint16_t value) noexcept {
  if (offset != kDigitalMode) {
    refuse();
  } else if (is_present()) {
    card_.digital_mode.store(value);
  }
}

}  // namespace twin::hal::rig::boards
