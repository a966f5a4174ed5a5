#include "hal/rig/pci1716.hpp"

#include <cmath>

namespace twin::hal::rig {
namespace {

// Byte offsets in BAR 2; all are accessed 16 bits wide.
constexpr std::uint32_t kAdData = 0x00;     // write: software trigger
constexpr std::uint32_t kAdRange = 0x02;    // of the channel selected by the multiplexer
constexpr std::uint32_t kAdMux = 0x04;      // start channel in the low byte, stop in the high
constexpr std::uint32_t kAdControl = 0x06;  // read: status
constexpr std::uint32_t kAdClear = 0x08;    // interrupt and FIFO
constexpr std::uint32_t kDac0 = 0x0A;       // converter 1 is the next word
constexpr std::uint32_t kDacRange = 0x0E;   // channel 0 in bits 2:0, channel 1 in 10:8
constexpr std::uint32_t kDigitalIo = 0x10;
constexpr std::uint32_t kBoardId = 0x14;

constexpr std::uint16_t kBothAt10V = 0x0101;
constexpr std::uint16_t kSoftwareTrigger = 0x0001;
constexpr std::uint16_t kFifoEmpty = 0x0100;
constexpr std::uint16_t kAllOnes16 = 0xFFFF;
constexpr int kPolls = 100;  // a conversion takes 4 us, an access about 1 us

constexpr std::uint32_t dac_register(std::size_t channel) {
  return kDac0 + 2 * static_cast<std::uint32_t>(channel);
}

double full_scale(Pci1716::InputRange range) noexcept {
  switch (range) {
    case Pci1716::InputRange::k5V:
      return 5.0;
    case Pci1716::InputRange::k2V5:
      return 2.5;
    case Pci1716::InputRange::k1V25:
      return 1.25;
    case Pci1716::InputRange::k10V:
      return 10.0;
  }
  return 10.0;
}

}  // namespace

void make_safe(io_port::IoPort& pci1716, std::uint16_t digital) noexcept {
  pci1716.write16(dac_register(0), kZeroVolts);
  pci1716.write16(dac_register(1), kZeroVolts);
  pci1716.write16(kDacRange, kBothAt10V);
  pci1716.write16(dac_register(0), kZeroVolts);
  pci1716.write16(dac_register(1), kZeroVolts);
  pci1716.write16(kDigitalIo, digital);
}

Pci1716::Pci1716(io_port::IoPort& port, std::uint16_t safe_digital) noexcept
    : port_(port), safe_digital_(safe_digital), digital_out_(safe_digital) {}

void Pci1716::open() noexcept {
  port_.write16(kDigitalIo, safe_digital_);
  make_safe();
}

void Pci1716::make_safe() noexcept {
  rig::make_safe(port_, safe_digital_);
  digital_out_.store(safe_digital_, std::memory_order_relaxed);
}

void Pci1716::set_volts(std::size_t channel, double volts) noexcept {
  const std::int64_t code = std::isfinite(volts) ? dac_.code(volts) : kZeroVolts;
  port_.write16(dac_register(channel), static_cast<std::uint16_t>(code));
}

void Pci1716::set_digital(std::uint16_t levels) noexcept {
  if (levels != digital_out()) {
    digital_out_.store(levels, std::memory_order_relaxed);
    port_.write16(kDigitalIo, levels);
  }
}

std::uint16_t Pci1716::digital_in() noexcept { return port_.read16(kDigitalIo); }

std::optional<double> Pci1716::read_volts(int channel, InputRange range) noexcept {
  const auto start = static_cast<std::uint16_t>(channel & 0xF);
  port_.write16(kAdControl, kSoftwareTrigger);
  port_.write16(kAdMux, static_cast<std::uint16_t>(start | start << 8));
  port_.write16(kAdRange, static_cast<std::uint16_t>(range));
  port_.write16(kAdClear, 0);
  port_.write16(kAdData, 0);
  for (int i = 0; i < kPolls; ++i) {
    const std::uint16_t status = port_.read16(kAdControl);
    if (status == kAllOnes16) {
      return std::nullopt;
    }
    if ((status & kFifoEmpty) == 0) {
      const int code = port_.read16(kAdData);
      return full_scale(range) * (code - 0x8000) / 0x8000;
    }
  }
  return std::nullopt;
}

int Pci1716::board_id() noexcept {
  const std::uint16_t raw = port_.read16(kBoardId);
  return raw == kAllOnes16 ? -1 : raw & 0xF;
}

bool Pci1716::is_gone() noexcept {
  return port_.read16(kBoardId) == kAllOnes16 && port_.read16(kAdControl) == kAllOnes16;
}

}  // namespace twin::hal::rig
