#include "hal/rig/boards/emulated_pci1716.hpp"

#include "hal/rig/boards/voltage_range.hpp"

namespace twin::hal::rig::boards {
namespace {

// Offsets in BAR2.
constexpr std::uint32_t kAdData = 0x00;  // write: software trigger
constexpr std::uint32_t kAdRange = 0x02;
constexpr std::uint32_t kAdMux = 0x04;
constexpr std::uint32_t kControl = 0x06;  // read: status
constexpr std::uint32_t kClearInterrupt = 0x08;
constexpr std::uint32_t kClearFifo = 0x09;
constexpr std::uint32_t kDac0 = 0x0A;
constexpr std::uint32_t kDac1 = 0x0C;
constexpr std::uint32_t kDacRange = 0x0E;
constexpr std::uint32_t kDigitalIo = 0x10;
constexpr std::uint32_t kBoardId = 0x14;
constexpr std::uint32_t kPci1716Bytes = 0x20;

constexpr std::uint16_t kSoftwareTrigger = 0x0001;
constexpr std::uint16_t kControlBits = 0x007F;
constexpr std::uint16_t kDifferential = 0x20;
constexpr std::uint16_t kFifoEmpty = 0x0100;
constexpr std::uint16_t kFifoHalfFull = 0x0200;
constexpr std::uint16_t kFifoFull = 0x0400;
constexpr std::uint16_t kAllOnes16 = 0xFFFF;

/// Voltage that a channel sees [V]; a differential one sees that of its pair, even less odd.
double input_volts(const Pci1716Registers& card, std::size_t channel, std::uint16_t gain) noexcept {
  const auto at = [&card](std::size_t i) -> double { return card.analogue_in[i].load(); };
  return (gain & kDifferential) != 0 ? at(channel & ~std::size_t{1}) - at(channel | 1)
                                     : at(channel);
}

}  // namespace

std::uint16_t EmulatedPci1716::status() const noexcept {
  const std::uint32_t held = card_.ad_head.load() - card_.ad_tail.load();
  const int fifo = (held == 0 ? kFifoEmpty : 0) | (held >= kAdFifoSize / 2 ? kFifoHalfFull : 0) |
                   (held >= kAdFifoSize ? kFifoFull : 0);
  return static_cast<std::uint16_t>((card_.control.load() & kControlBits) | fifo);
}

std::uint16_t EmulatedPci1716::take_sample() noexcept {
  const std::uint32_t tail = card_.ad_tail.load();
  if (card_.ad_head.load() == tail) {
    return junk(kAdData);
  }
  const std::uint16_t sample = card_.ad_fifo[tail % kAdFifoSize].load();
  card_.ad_tail.store(tail + 1);
  return sample;
}

void EmulatedPci1716::set_gain(std::uint16_t value) noexcept {
  card_.ad_gain[card_.ad_mux.load() & 0xF].store(value);
}

void EmulatedPci1716::set_mux(std::uint16_t value) noexcept {
  card_.ad_mux.store(value);
  card_.ad_next.store(static_cast<std::uint8_t>(value & 0xF));
}

void EmulatedPci1716::trigger() noexcept {
  const std::uint32_t head = card_.ad_head.load();
  if ((card_.control.load() & kSoftwareTrigger) == 0 ||
      head - card_.ad_tail.load() >= kAdFifoSize) {
    return;
  }
  const std::uint16_t mux = card_.ad_mux.load();
  const std::uint8_t channel = card_.ad_next.load() & 0xF;
  const std::uint16_t gain = card_.ad_gain[channel].load();
  card_.ad_fifo[head % kAdFifoSize].store(
      code(analogue_input_range(gain), input_volts(card_, channel, gain)));
  card_.ad_head.store(head + 1);
  const int next = channel == ((mux >> 8) & 0xF) ? mux & 0xF : (channel + 1) & 0xF;
  card_.ad_next.store(static_cast<std::uint8_t>(next));
}

void EmulatedPci1716::clear_fifo() noexcept { card_.ad_tail.store(card_.ad_head.load()); }

std::uint16_t EmulatedPci1716::read16(std::uint32_t offset) noexcept {
  if (!takes(offset, 2, kPci1716Bytes)) {
    return kAllOnes16;
  }
  switch (offset) {
    case kAdData:
      return take_sample();
    case kControl:
      return status();
    case kDigitalIo:
      return card_.digital_in.load(std::memory_order_acquire);
    case kBoardId:
      return static_cast<std::uint16_t>((junk(offset) & 0xFFF0) | (card_.board_id.load() & 0xF));
    default:
      return junk(offset);
  }
}

void EmulatedPci1716::write16(std::uint32_t offset, std::uint16_t value) noexcept {
  if (!takes(offset, 2, kPci1716Bytes)) {
    return;
  }
  switch (offset) {
    case kAdData:
      return trigger();
    case kAdRange:
      return set_gain(value);
    case kAdMux:
      return set_mux(value);
    case kControl:
      return card_.control.store(value);
    case kClearInterrupt:  // and the FIFO beside it
      return clear_fifo();
    case kDac0:
      return card_.dac[0].store(value, std::memory_order_release);
    case kDac1:
      return card_.dac[1].store(value, std::memory_order_release);
    case kDacRange:
      return card_.dac_range.store(value, std::memory_order_release);
    case kDigitalIo:
      return card_.digital_out.store(value, std::memory_order_release);
    default:
      return;
  }
}

void EmulatedPci1716::write8(std::uint32_t offset, std::uint8_t) noexcept {
  if (offset == kClearFifo && is_present()) {
    clear_fifo();
  } else if (offset != kClearFifo && offset != kClearInterrupt) {
    refuse();
  }
}

}  // namespace twin::hal::rig::boards
