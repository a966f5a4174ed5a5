#include "hal/rig/io_port/ioperm_port.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#if defined(__x86_64__) || defined(__i386__)
#include <sys/io.h>
#define TWIN_HAS_PORT_INSTRUCTIONS 1
#else
#define TWIN_HAS_PORT_INSTRUCTIONS 0
#endif

namespace twin::hal::rig::io_port {

#if TWIN_HAS_PORT_INSTRUCTIONS

Expected<std::unique_ptr<IopermPort>> IopermPort::open(std::uint32_t base) {
  if (base == 0 || base > 0x10000 - kPorts) {
    return fail(ErrorCode::kMachine,
                fmt::format("{:#x} is no base of a card's I/O ports: 0x1 to {:#x}", base,
                            0x10000 - kPorts));
  }
  if (::ioperm(base, kPorts, 1) == 0) {
    return std::unique_ptr<IopermPort>(new IopermPort(base));
  }
  return fail(ErrorCode::kMachine,
              fmt::format("ioperm() of ports {:#x} to {:#x}: {}; run as root or with "
                          "CAP_SYS_RAWIO, or set rig.access = \"sysfs\"",
                          base, base + kPorts - 1, std::strerror(errno)));
}

IopermPort::~IopermPort() { ::ioperm(base_, kPorts, 0); }

std::uint8_t IopermPort::read8(std::uint32_t offset) noexcept { return ::inb(port(offset)); }
std::uint16_t IopermPort::read16(std::uint32_t offset) noexcept { return ::inw(port(offset)); }
std::uint32_t IopermPort::read32(std::uint32_t offset) noexcept { return ::inl(port(offset)); }
void IopermPort::write8(std::uint32_t offset, std::uint8_t value) noexcept {
  ::outb(value, port(offset));
}
void IopermPort::write16(std::uint32_t offset, std::uint16_t value) noexcept {
  ::outw(value, port(offset));
}
void IopermPort::write32(std::uint32_t offset, std::uint32_t value) noexcept {
  ::outl(value, port(offset));
}

#else

Expected<std::unique_ptr<IopermPort>> IopermPort::open(std::uint32_t) {
  return fail(ErrorCode::kMachine,
              "rig.access = \"ioperm\" needs an x86 processor; set it to \"sysfs\"");
}

IopermPort::~IopermPort() = default;
std::uint8_t IopermPort::read8(std::uint32_t) noexcept { return 0xFF; }
std::uint16_t IopermPort::read16(std::uint32_t) noexcept { return 0xFFFF; }
std::uint32_t IopermPort::read32(std::uint32_t) noexcept { return 0xFFFFFFFF; }
void IopermPort::write8(std::uint32_t, std::uint8_t) noexcept {}
void IopermPort::write16(std::uint32_t, std::uint16_t) noexcept {}
void IopermPort::write32(std::uint32_t, std::uint32_t) noexcept {}

#endif

}  // namespace twin::hal::rig::io_port
