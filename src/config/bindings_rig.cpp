#include "config/binding.hpp"

// The settings of the real rig: cards, wires, signals.
namespace twin::config {
namespace {

using hal::rig::AxisWiring;
using hal::rig::Line;
using hal::rig::RigSettings;
using List = std::vector<Binding>;

constexpr double kLastLine = 15.0;  // of the PCI-1716, outputs and inputs alike

// A digital line: `<name>_do` or `<name>_di`, and `<name>_level`.
void add_line(List& list, const std::string& section, const std::string& name, const char* kind,
              Line& line, double first, const char* doc) {
  list.push_back({section, name + kind, "", &line.channel, first, kLastLine, doc});
  list.push_back({section, name + "_level", "", choice(line.when, {"low", "high"}), 0.0, 0.0,
                  "level at which that signal is given"});
}

void add_axis(List& list, const std::string& section, AxisWiring& a) {
  list.push_back({section, "dac", "", &a.dac, 0.0, 1.0, "analogue output that feeds V-REF"});
  list.push_back({section, "counter", "", &a.counter, 0.0, 3.0, "counter of the encoder"});
  list.push_back({section, "vref_reversed", "", &a.vref_reversed, 0.0, 0.0,
                  "a positive voltage moves towards smaller positions"});
  list.push_back({section, "encoder_reversed", "", &a.encoder_reversed, 0.0, 0.0,
                  "counts fall where the position grows"});
  list.push_back({section, "encoder", "um_per_count", &a.mm_per_count, 0.0, 1e3,
                  "encoder scale after fourfold evaluation; 0: that of the table", 1e3});
  list.push_back({section, "vref_scale", "mm_per_s_per_V", &a.mm_per_s_per_volt, 0.0, 1e3,
                  "velocity per volt of V-REF; 0: that of the table"});
  list.push_back({section, "vref_trim", "V", &a.vref_trim, -1.0, 1.0,
                  "added at the converter against the drive's offset"});
  add_line(list, section, "servo_on", "_do", a.servo_on, 0.0, "output /S-ON");
  add_line(list, section, "alarm_reset", "_do", a.alarm_reset, -1.0,
           "output /ALM-RST; -1: not wired");
  add_line(list, section, "alarm", "_di", a.alarm, 0.0, "input ALM");
  add_line(list, section, "ready", "_di", a.ready, -1.0, "input /S-RDY; -1: not wired");
  add_line(list, section, "limit_positive", "_di", a.limit_positive, -1.0,
           "input P-OT; -1: not wired");
  add_line(list, section, "limit_negative", "_di", a.limit_negative, -1.0,
           "input N-OT; -1: not wired");
  list.push_back({section, "vref_readback_ai", "", &a.vref_readback, -1.0, kLastLine,
                  "analogue input that sees V-REF; -1: none"});
}

}  // namespace

std::vector<Binding> rig_bindings(RigSettings& rig) {
  const char* section = "rig";
  List list;
  list.push_back({section, "driver", "", choice(rig.driver, {"registers", "daqnavi"}), 0.0, 0.0,
                  "how the cards are driven"});
  list.push_back({section, "access", "", choice(rig.access, {"sysfs", "ioperm"}), 0.0, 0.0,
                  "how their registers are reached"});
  list.push_back({section, "sysfs", "", &rig.sysfs, 1.0, 0.0, "root below which cards are found"});
  list.push_back({section, "daqnavi_library", "", &rig.daqnavi_library, 1.0, 0.0,
                  "name or path; for daqnavi only"});
  list.push_back({section, "pci1716_board_id", "", &rig.pci1716_board_id, 0.0, 15.0,
                  "switch on the PCI-1716"});
  list.push_back({section, "pci1784_board_id", "", &rig.pci1784_board_id, 0.0, 15.0,
                  "switch on the PCI-1784"});
  list.push_back({section, "counter_mode", "", &rig.counter_mode, 0.0, 65535.0,
                  "mode word of the counters, 0x193 = 403"});
  list.push_back({section, "clock_control", "", &rig.clock_control, 0.0, 2147483647.0,
                  "clock word, 0x03010003 = 50397187"});
  list.push_back({section, "reset_counters", "", &rig.reset_counters, 0.0, 0.0,
                  "set the counters to 0 when the cards are opened"});
  list.push_back({section, "counter_reset_offset", "", &rig.counter_reset_offset, 4.0, 252.0,
                  "register that does it, 0x2C = 44; a multiple of 4"});
  list.push_back({section, "read_index", "", &rig.read_index, 0.0, 0.0,
                  "look for index marks in the interrupt status"});
  list.push_back({section, "alarm_reset_time", "ms", &rig.alarm_reset_time, 1.0, 1e4,
                  "length of the alarm reset pulse", 1e3});
  add_axis(list, "rig.x", rig.axis[hal::kX]);
  add_axis(list, "rig.y", rig.axis[hal::kY]);
  return list;
}

}  // namespace twin::config
