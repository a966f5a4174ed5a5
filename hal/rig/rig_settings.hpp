#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "hal/machine.hpp"
#include "hal/rig/io_port/io_port.hpp"

/// Everything about cards, wires and signals of the real rig that can differ from rig to rig or is
/// not confirmed by a source; section [rig] of the machine file.
namespace twin::hal::rig {

/// How the cards are driven.
enum class Driver : std::uint8_t {
  kRegisters,  ///< their registers, worked by this program
  kDaqnavi,    ///< Advantech's DAQNavi library, loaded at run time
};

/// The level of a digital line at which its signal is given.
enum class Level : std::uint8_t { kLow, kHigh };

/// One digital line.
struct Line {
  int channel = -1;           ///< bit, 0 to 15; -1: not wired
  Level when = Level::kHigh;  ///< level at which the signal is given
};

/// Wires of one axis.
struct AxisWiring {
  int dac = 0;                          ///< converter of the PCI-1716 that feeds V-REF, 0 or 1
  int counter = 0;                      ///< counter of the PCI-1784, 0 to 3
  bool vref_reversed = false;           ///< a positive voltage moves towards smaller positions
  bool encoder_reversed = false;        ///< counts fall where the position grows
  double mm_per_count = 0.0;            ///< encoder scale [mm/count]; 0: that of the table
  double mm_per_s_per_volt = 0.0;       ///< V-REF scale [mm/s/V]; 0: that of the table
  double vref_trim = 0.0;               ///< added at the converter against the drive's offset [V]
  Line servo_on{0, Level::kHigh};       ///< output /S-ON
  Line alarm_reset{1, Level::kHigh};    ///< output /ALM-RST
  Line alarm{0, Level::kLow};           ///< input ALM: off means alarm, so that a broken wire does
  Line ready{1, Level::kHigh};          ///< input /S-RDY
  Line limit_positive{2, Level::kLow};  ///< input P-OT: normally closed
  Line limit_negative{3, Level::kLow};  ///< input N-OT: normally closed
  int vref_readback = -1;               ///< analogue input that sees V-REF; -1: none
};

/// The second axis on the next lines.
inline AxisWiring default_y_wiring() {
  AxisWiring y;
  y.dac = 1;
  y.counter = 1;
  y.servo_on.channel = 2;
  y.alarm_reset.channel = 3;
  y.alarm.channel = 4;
  y.ready.channel = 5;
  y.limit_positive.channel = 6;
  y.limit_negative.channel = 7;
  return y;
}

/// The whole rig.
struct RigSettings {
  Driver driver = Driver::kRegisters;
  io_port::Access access = io_port::Access::kSysfs;
  std::string sysfs = "/sys";                    ///< root under which PCI cards are looked for
  std::string daqnavi_library = "libbiodaq.so";  ///< name or path
  int pci1716_board_id = 0;                      ///< its switch, 0 to 15
  int pci1784_board_id = 0;                      ///< its switch, 0 to 15
  /// Mode word of the counters: x4, input filter, reset to 0, software latch. The value is one that
  /// ran [PRECITEC]; what bits 4 and 7 of it do is not confirmed.
  int counter_mode = 0x193;
  /// Clock word: 1 MHz filter clock, which counts up to 0.25 MHz of phase A. The value is one that
  /// ran [PRECITEC]; words for faster clocks are not confirmed.
  int clock_control = 0x03010003;
  /// Set the counters to 0 when the cards are opened. Not needed: zero is kept in software.
  bool reset_counters = false;
  /// Register that sets counters to 0, used with reset_counters only; inferred, not confirmed.
  int counter_reset_offset = 0x2C;
  /// Look at the index bits of the interrupt status. Not confirmed: that they are set while the
  /// interrupts themselves are off. False: index marks are never seen.
  bool read_index = true;
  double alarm_reset_time = 0.1;  ///< length of the reset pulse [s]
  std::array<AxisWiring, kServoAxes> axis{AxisWiring{}, default_y_wiring()};
};

}  // namespace twin::hal::rig
