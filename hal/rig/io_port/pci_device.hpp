#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace twin::hal::rig::io_port {

/// A PCI device as sysfs shows it.
struct PciDevice {
  std::string folder;                  ///< "/sys/bus/pci/devices/0000:03:00.0"
  std::string address;                 ///< "0000:03:00.0"
  std::uint16_t vendor = 0;            ///< 0x13fe for Advantech
  std::uint16_t device = 0;            ///< 0x1716
  std::uint16_t subsystem_device = 0;  ///< tells variants of a card; 0 where it cannot be read
  std::string driver;                  ///< kernel driver bound to it, empty if none
};

/// Folder of the devices under a sysfs root: "/sys/bus/pci/devices".
std::string pci_folder(const std::string& sysfs);

/// All devices of a vendor and kind, in the order of their addresses. Those whose IDs cannot be
/// read are left out.
std::vector<PciDevice> pci_devices(const std::string& sysfs, std::uint16_t vendor,
                                   std::uint16_t device);

/// First I/O port of a base address register, from the device's file `resource`: one line a BAR,
/// "0xSTART 0xEND 0xFLAGS".
///
/// @returns a kMachine error where the file is unreadable, cut short or garbled, or where the BAR
/// holds no I/O ports
Expected<std::uint32_t> io_base(const PciDevice& device, int bar);

/// Switches a device on that no kernel driver has switched on (file `enable`), so that it answers.
Expected<void> enable(const PciDevice& device);

}  // namespace twin::hal::rig::io_port
