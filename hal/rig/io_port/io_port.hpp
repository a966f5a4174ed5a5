#pragma once

#include <cstdint>

namespace twin::hal::rig::io_port {

/// How registers are reached.
enum class Access : std::uint8_t {
  kSysfs,   ///< resource file of the card, pread and pwrite
  kIoperm,  ///< port instructions after ioperm()
};

/// The registers of one card: 8, 16 and 32 bit accesses at byte offsets of its BAR.
///
/// The seam below the card drivers: a sysfs resource file, port I/O, or an emulated board. An
/// access is exactly as wide as it is called; a driver picks the width the register needs. All
/// calls are real-time safe. A read that fails gives all ones, as a missing PCI card does, and
/// error() tells it from a card that answers so.
class IoPort {
 public:
  IoPort() = default;
  IoPort(const IoPort&) = delete;
  IoPort& operator=(const IoPort&) = delete;
  virtual ~IoPort() = default;

  virtual std::uint8_t read8(std::uint32_t offset) noexcept = 0;
  virtual std::uint16_t read16(std::uint32_t offset) noexcept = 0;
  virtual std::uint32_t read32(std::uint32_t offset) noexcept = 0;
  virtual void write8(std::uint32_t offset, std::uint8_t value) noexcept = 0;
  virtual void write16(std::uint32_t offset, std::uint16_t value) noexcept = 0;
  virtual void write32(std::uint32_t offset, std::uint32_t value) noexcept = 0;

  /// errno of the first access that failed since the port was opened; 0 when none did.
  virtual int error() const noexcept = 0;
};

}  // namespace twin::hal::rig::io_port
