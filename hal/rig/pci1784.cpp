#include "hal/rig/pci1784.hpp"

#include <algorithm>

namespace twin::hal::rig {
namespace {

// Byte offsets in BAR 2; all are accessed 32 bits wide.
constexpr std::uint32_t kCounter0 = 0x00;   // write: mode; read: latched value; 4 bytes a counter
constexpr std::uint32_t kInterrupt = 0x20;  // write: enable; read: status
constexpr std::uint32_t kClock = 0x24;      // read: clears the interrupt status
constexpr std::uint32_t kLatch = 0x28;      // read: board ID
constexpr std::uint32_t kDigitalIn = 0x30;  // in bits 7:4

constexpr std::uint32_t kAllCounters = 0x0F;
constexpr std::uint32_t kAllOnes32 = 0xFFFFFFFF;
constexpr int kIndexBit = 8;  // of counter 0 in the interrupt status

constexpr std::uint32_t counter_register(std::size_t counter) {
  return kCounter0 + 4 * static_cast<std::uint32_t>(counter);
}

}  // namespace

Pci1784::Pci1784(io_port::IoPort& port, const RigSettings& settings) noexcept
    : port_(port),
      mode_(static_cast<std::uint32_t>(settings.counter_mode)),
      clock_control_(static_cast<std::uint32_t>(settings.clock_control)),
      reset_offset_(
          settings.reset_counters ? static_cast<std::uint32_t>(settings.counter_reset_offset) : 0),
      reads_index_(settings.read_index) {}

void Pci1784::open() noexcept {
  for (std::size_t i = 0; i < kCounters; ++i) {
    port_.write32(counter_register(i), mode_);
  }
  port_.write32(kInterrupt, 0);
  port_.write32(kClock, clock_control_);
  if (reset_offset_ != 0) {
    port_.write32(reset_offset_, kAllCounters);
  }
  port_.read32(kClock);  // forgets index marks of before
  last_ = latch();
  path_.fill(0);
}

Pci1784::Raw Pci1784::latch() noexcept {
  port_.write32(kLatch, kAllCounters);
  Raw raw{};
  for (std::size_t i = 0; i < kCounters; ++i) {
    raw[i] = port_.read32(counter_register(i));
  }
  return raw;
}

bool Pci1784::read(std::array<std::int64_t, kCounters>& counts) noexcept {
  const Raw raw = latch();
  const bool all_ones =
      std::all_of(raw.begin(), raw.end(), [](std::uint32_t value) { return value == kAllOnes32; });
  if (all_ones && board_id() < 0) {
    return false;
  }
  for (std::size_t i = 0; i < kCounters; ++i) {
    path_[i] += static_cast<std::int32_t>(raw[i] - last_[i]);
  }
  last_ = raw;
  counts = path_;
  return true;
}

std::uint8_t Pci1784::take_index() noexcept {
  if (!reads_index_) {
    return 0;
  }
  const std::uint32_t status = port_.read32(kInterrupt);
  const auto seen = static_cast<std::uint8_t>(status >> kIndexBit & 0xF);
  if (seen != 0 && status != kAllOnes32) {
    port_.read32(kClock);
    return seen;
  }
  return 0;
}

std::uint8_t Pci1784::digital_in() noexcept {
  return static_cast<std::uint8_t>(port_.read32(kDigitalIn) >> 4 & 0xF);
}

int Pci1784::board_id() noexcept {
  const std::uint32_t raw = port_.read32(kLatch);
  return raw == kAllOnes32 ? -1 : static_cast<int>(raw & 0xF);
}

}  // namespace twin::hal::rig
