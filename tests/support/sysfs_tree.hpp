#pragma once

#include <fmt/format.h>

#include <string>

#include "tests/support/files.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::test {

/// A made-up sysfs with PCI cards whose registers are plain files.
class SysfsTree {
 public:
  /// Readable for every user, as /sys is.
  SysfsTree() { std::filesystem::permissions(folder_.path(), std::filesystem::perms(0755)); }
  std::string root() const { return folder_.path().string(); }
  const TempFolder& folder() const { return folder_; }
  static std::string inside(const std::string& address, const std::string& file) {
    return "bus/pci/devices/" + address + "/" + file;
  }

  /// A card with its board ID switch; 64 registers of one byte, all others 0.
  void add(const std::string& address, int device, int board_id, int base = 0xE800) const {
    put(address, "vendor", "0x13fe\n");
    put(address, "device", fmt::format("{:#06x}\n", device));
    put(address, "subsystem_device", "0x0000\n");
    put(address, "enable", "1\n");
    const std::string none = "0x0000000000000000 0x0000000000000000 0x0000000000000000\n";
    put(address, "resource",
        none + "0x000000000000e400 0x000000000000e47f 0x0000000000040101\n" +
            fmt::format("{:#018x} {:#018x} 0x0000000000040101\n", base, base + 0x3F) + none);
    std::string registers(64, '\0');
    registers[device == 0x1716 ? 0x14 : 0x28] = static_cast<char>(board_id);
    put(address, "resource2", registers);
  }
  void put(const std::string& address, const std::string& file, const std::string& text) const {
    folder_.put(inside(address, file), text);
  }
  std::string get(const std::string& address, const std::string& file) const {
    return content(folder_ / inside(address, file));
  }
  void bind(const std::string& address, const std::string& driver) const {
    std::filesystem::create_directory_symlink("../../../../bus/pci/drivers/" + driver,
                                              folder_.path() / inside(address, "driver"));
  }

 private:
  TempFolder folder_;
};

}  // namespace twin::test
