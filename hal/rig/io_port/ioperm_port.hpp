#pragma once

#include <memory>

#include "core/error.hpp"
#include "hal/rig/io_port/io_port.hpp"

namespace twin::hal::rig::io_port {

/// Registers by port instructions (in, out), permitted by ioperm(): no system call per access.
///
/// x86 only, and needs CAP_SYS_RAWIO. The permission belongs to the thread that opens the port and
/// to threads it starts afterwards; a thread that existed before is killed by its first access. An
/// instruction cannot fail, so error() stays 0.
class IopermPort final : public IoPort {
 public:
  static constexpr std::uint32_t kPorts = 0x40;  ///< ports that are asked for, from the base on

  /// @param base  first port of the card's BAR
  static Expected<std::unique_ptr<IopermPort>> open(std::uint32_t base);
  ~IopermPort() override;

  std::uint8_t read8(std::uint32_t offset) noexcept override;
  std::uint16_t read16(std::uint32_t offset) noexcept override;
  std::uint32_t read32(std::uint32_t offset) noexcept override;
  void write8(std::uint32_t offset, std::uint8_t value) noexcept override;
  void write16(std::uint32_t offset, std::uint16_t value) noexcept override;
  void write32(std::uint32_t offset, std::uint32_t value) noexcept override;
  int error() const noexcept override { return 0; }

 private:
  explicit IopermPort(std::uint32_t base) noexcept : base_(base) {}
  std::uint16_t port(std::uint32_t offset) const noexcept {
    return static_cast<std::uint16_t>(base_ + offset);
  }

  std::uint32_t base_;
};

}  // namespace twin::hal::rig::io_port
