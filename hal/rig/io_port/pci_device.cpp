#include "hal/rig/io_port/pci_device.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

namespace twin::hal::rig::io_port {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kIoFlag = 0x100;  // IORESOURCE_IO

// A number as sysfs writes it, "0x13fe".
std::optional<std::uint64_t> hex_number(const std::string& text) {
  if (!text.starts_with("0x") || text.size() < 3 || text.size() > 18) {
    return std::nullopt;
  }
  char* end = nullptr;
  const std::uint64_t value = std::strtoull(text.c_str() + 2, &end, 16);
  return *end == '\0' ? std::optional(value) : std::nullopt;
}

std::optional<std::uint16_t> id_in(const fs::path& file) {
  std::string word;
  std::ifstream(file) >> word;
  const auto value = hex_number(word);
  return value && *value <= 0xFFFF ? std::optional(static_cast<std::uint16_t>(*value))
                                   : std::nullopt;
}

std::string driver_of(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_symlink(folder / "driver", error)) {
    return {};
  }
  const fs::path target = fs::read_symlink(folder / "driver", error);
  return error ? "of unknown name" : target.filename().string();
}

tl::unexpected<Error> refuse(std::string why) { return fail(ErrorCode::kMachine, std::move(why)); }

}  // namespace

std::string pci_folder(const std::string& sysfs) {
  return (fs::path(sysfs) / "bus/pci/devices").string();
}

std::vector<PciDevice> pci_devices(const std::string& sysfs, std::uint16_t vendor,
                                   std::uint16_t device) {
  std::vector<PciDevice> devices;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(pci_folder(sysfs), error)) {
    const fs::path& folder = entry.path();
    if (id_in(folder / "vendor") == vendor && id_in(folder / "device") == device) {
      devices.push_back({.folder = folder.string(),
                         .address = folder.filename().string(),
                         .vendor = vendor,
                         .device = device,
                         .subsystem_device = id_in(folder / "subsystem_device").value_or(0),
                         .driver = driver_of(folder)});
    }
  }
  std::sort(devices.begin(), devices.end(),
            [](const PciDevice& a, const PciDevice& b) { return a.address < b.address; });
  return devices;
}

Expected<std::uint32_t> io_base(const PciDevice& device, int bar) {
  const std::string file = device.folder + "/resource";
  std::ifstream lines(file);
  std::string line;
  for (int i = 0; i <= bar; ++i) {
    if (!std::getline(lines, line)) {
      return refuse(fmt::format("{} has no line {} for BAR {}", file, bar + 1, bar));
    }
  }
  std::istringstream words(line);
  std::string start, end, flags;
  words >> start >> end >> flags;
  const auto first = hex_number(start);
  const auto last = hex_number(end);
  const auto bits = hex_number(flags);
  if (!first || !last || !bits) {
    return refuse(fmt::format("line {} of {} is \"{}\", not three numbers in hexadecimal", bar + 1,
                              file, line));
  }
  if ((*bits & kIoFlag) == 0 || *first == 0 || *last < *first || *last > 0xFFFF) {
    return refuse(fmt::format("BAR {} ({}) is no range of I/O ports", bar, line));
  }
  return static_cast<std::uint32_t>(*first);
}

Expected<void> enable(const PciDevice& device) {
  const std::string file = device.folder + "/enable";
  std::string state;
  if (!(std::ifstream(file) >> state)) {
    return refuse("cannot read " + file);
  }
  if (state != "0") {
    return {};
  }
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  const bool done = descriptor >= 0 && ::write(descriptor, "1", 1) == 1;
  const int reason = errno;
  if (descriptor >= 0) {
    ::close(descriptor);
  }
  if (!done) {
    return refuse(
        fmt::format("it is switched off, and writing 1 to {} fails: {}; run as "
                    "root, or do that once as root",
                    file, std::strerror(reason)));
  }
  return {};
}

}  // namespace twin::hal::rig::io_port
