#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "hal/rig/io_port/io_port.hpp"

namespace twin::hal::rig::io_port {

/// The first errno of a port; a later one changes nothing. Lock-free, so that a signal handler may
/// use the port.
class PortError {
 public:
  void note(int number) noexcept {
    int none = 0;
    first_.compare_exchange_strong(none, number, std::memory_order_relaxed);
  }
  int first() const noexcept { return first_.load(std::memory_order_relaxed); }

 private:
  std::atomic<int> first_{0};
};

/// Registers through a card's `resourceN` file: the kernel turns a pread or pwrite of 1, 2 or 4
/// bytes at a register's offset into one in or out instruction of that width
/// [Linux, Documentation/PCI/sysfs-pci.rst, pci_resource_io].
///
/// Needs neither a kernel driver nor I/O privilege, only the file's permission. Safe in a signal
/// handler.
class SysfsPort final : public IoPort {
 public:
  /// @param file  "/sys/bus/pci/devices/0000:03:00.0/resource2"
  static Expected<std::unique_ptr<SysfsPort>> open(const std::string& file);
  ~SysfsPort() override;

  std::uint8_t read8(std::uint32_t offset) noexcept override;
  std::uint16_t read16(std::uint32_t offset) noexcept override;
  std::uint32_t read32(std::uint32_t offset) noexcept override;
  void write8(std::uint32_t offset, std::uint8_t value) noexcept override;
  void write16(std::uint32_t offset, std::uint16_t value) noexcept override;
  void write32(std::uint32_t offset, std::uint32_t value) noexcept override;
  int error() const noexcept override { return error_.first(); }

 private:
  explicit SysfsPort(int descriptor) noexcept : descriptor_(descriptor) {}

  int descriptor_;
  PortError error_;
};

}  // namespace twin::hal::rig::io_port
