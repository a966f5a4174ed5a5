#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "hal/rig/io_port/io_port.hpp"

namespace twin::hal::rig::io_port {

/// Where the registers of a card are, so that another process can open them as well.
struct PortAddress {
  Access access = Access::kSysfs;
  std::string path;        ///< resource file; for kSysfs
  std::uint32_t base = 0;  ///< first I/O port; for kIoperm

  bool operator==(const PortAddress&) const = default;
};

/// "sysfs:/sys/bus/pci/devices/0000:03:00.0/resource2" or "ioperm:0xe800"
std::string to_text(const PortAddress& address);

/// The address back from its text; kUsage for anything else.
Expected<PortAddress> port_address_from_text(std::string_view text);

/// Opens the port; the error says what is missing and what to do.
Expected<std::unique_ptr<IoPort>> open_port(const PortAddress& address);

}  // namespace twin::hal::rig::io_port
