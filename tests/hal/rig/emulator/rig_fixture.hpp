#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "hal/dac.hpp"
#include "hal/rig/boards/emulated_pci1716.hpp"
#include "hal/rig/boards/emulated_pci1784.hpp"
#include "hal/rig/emulator/emulated_rig.hpp"
#include "tests/support/table_files.hpp"

namespace twin::test {

inline constexpr double kPeriod = 1e-3;  ///< [s]

/// The table without hum.
inline hal::mujoco::TableParams quiet_table() {
  hal::mujoco::TableParams table = default_table();
  for (hal::mujoco::AxisParams& axis : table.axis) {
    axis.drive.hum_amplitude = 0.0;
  }
  return table;
}

/// An emulated rig worked by raw register accesses, as a driver would.
class EmulatorBench {
 public:
  explicit EmulatorBench(const hal::rig::RigSettings& wiring = {},
                         std::vector<hal::rig::emulator::Fault> faults = {},
                         const hal::mujoco::TableParams& table = default_table())
      : wiring_(wiring),
        rig(table, wiring, std::move(faults)),
        pci1716(rig.boards().pci1716),
        pci1784(rig.boards().pci1784) {
    if (Expected<void> on = rig.power_on(kPeriod); !on) {
      throw std::runtime_error(to_string(on.error()));
    }
    pci1716.write16(0x0A, 0x8000);
    pci1716.write16(0x0C, 0x8000);
    pci1716.write16(0x0E, 0x0101);
    for (std::uint32_t counter = 0; counter < 4; ++counter) {
      pci1784.write32(4 * counter, 0x193);
    }
    pci1784.write32(0x24, 0x03010003);
    write(0.0, 0.0, false);
  }

  /// Voltages of X and Y through their converters, with the servos on or off.
  void write(double x, double y, bool servo_on = true) {
    std::uint16_t outputs = 0;
    for (const hal::rig::AxisWiring& axis : wiring_.axis) {
      outputs |= line(axis.servo_on, servo_on);
      outputs |= line(axis.alarm_reset, false);
    }
    pci1716.write16(0x10, outputs);
    pci1716.write16(dac_offset(hal::kX), code(x));
    pci1716.write16(dac_offset(hal::kY), code(y));
  }

  /// Latches all counters and reads that of an axis.
  std::int32_t counts(hal::Axis axis) {
    pci1784.write32(0x28, 0x0F);
    return static_cast<std::int32_t>(
        pci1784.read32(4 * static_cast<std::uint32_t>(wiring_.axis[axis].counter)));
  }

  bool input(int channel) { return (pci1716.read16(0x10) >> channel & 1) != 0; }

  /// Lets periods pass with the outputs as they are.
  void pass(int periods) {
    for (int k = 0; k < periods; ++k) {
      if (!rig.advance()) {
        throw std::runtime_error(rig.last_error());
      }
    }
  }

  static std::uint16_t line(const hal::rig::Line& line, bool is_given) {
    const bool is_high = is_given == (line.when == hal::rig::Level::kHigh);
    return line.channel >= 0 && is_high ? static_cast<std::uint16_t>(1U << line.channel)
                                        : std::uint16_t{0};
  }

 private:
  static std::uint16_t code(double volts) {
    return static_cast<std::uint16_t>(hal::Dac(16).code(volts));
  }
  std::uint32_t dac_offset(hal::Axis axis) const {
    return wiring_.axis[axis].dac == 0 ? 0x0A : 0x0C;
  }

  hal::rig::RigSettings wiring_;

 public:
  hal::rig::emulator::EmulatedRig rig;
  hal::rig::boards::EmulatedPci1716 pci1716;
  hal::rig::boards::EmulatedPci1784 pci1784;
};

}  // namespace twin::test
