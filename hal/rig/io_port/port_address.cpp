#include "hal/rig/io_port/port_address.hpp"

#include <fmt/format.h>

#include <charconv>

#include "hal/rig/io_port/ioperm_port.hpp"
#include "hal/rig/io_port/sysfs_port.hpp"

namespace twin::hal::rig::io_port {
namespace {

constexpr std::string_view kSysfsPrefix = "sysfs:";
constexpr std::string_view kIopermPrefix = "ioperm:0x";

}  // namespace

std::string to_text(const PortAddress& address) {
  return address.access == Access::kSysfs ? fmt::format("{}{}", kSysfsPrefix, address.path)
                                          : fmt::format("{}{:x}", kIopermPrefix, address.base);
}

Expected<PortAddress> port_address_from_text(std::string_view text) {
  if (text.starts_with(kSysfsPrefix) && text.size() > kSysfsPrefix.size()) {
    return PortAddress{.access = Access::kSysfs,
                       .path = std::string(text.substr(kSysfsPrefix.size()))};
  }
  if (text.starts_with(kIopermPrefix)) {
    const std::string_view digits = text.substr(kIopermPrefix.size());
    std::uint32_t base = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), base, 16);
    if (error == std::errc{} && end == digits.data() + digits.size() && base < 0x10000) {
      return PortAddress{.access = Access::kIoperm, .path = {}, .base = base};
    }
  }
  return fail(ErrorCode::kUsage,
              fmt::format("\"{}\" is no port: sysfs:<resource file> or ioperm:0x<base>", text));
}

Expected<std::unique_ptr<IoPort>> open_port(const PortAddress& address) {
  const auto as_port = [](auto port) { return std::unique_ptr<IoPort>(std::move(port)); };
  return address.access == Access::kSysfs ? SysfsPort::open(address.path).map(as_port)
                                          : IopermPort::open(address.base).map(as_port);
}

}  // namespace twin::hal::rig::io_port
