#include "config/binding.hpp"

// The settings of the monitors and of the wall clock.
namespace twin::config {
namespace {

void add_safety(std::vector<Binding>& list, motion::SafetySettings& s) {
  const char* section = "safety";
  list.push_back({section, "tracking_error", "mm", &s.tracking_error, 1e-3, 1e3,
                  "largest tracking error at rest"});
  list.push_back({section, "tracking_error_per_feedrate", "ms", &s.tracking_error_per_feedrate, 0.0,
                  1e4, "added to it per mm/s of feedrate, um", 1e3});
  list.push_back({section, "tracking_filter_time", "ms", &s.tracking_filter_time, 0.0, 1e3,
                  "how long it may be exceeded, up to twice its value", 1e3});
  list.push_back({section, "runaway", "mm", &s.runaway, 1e-3, 1e3,
                  "tracking error of an axis that moves against its drive command"});
  list.push_back({section, "runaway_per_feedrate", "ms", &s.runaway_per_feedrate, 0.0, 1e4,
                  "added to it per mm/s of feedrate, um", 1e3});
  list.push_back({section, "frozen_encoder", "mm", &s.frozen_encoder, 1e-3, 1e3,
                  "way of the set point on which the counts must change"});
  list.push_back({section, "count_step_ratio", "", &s.count_step_ratio, 1.0, 1e3,
                  "fastest plausible counts over the largest feedrate"});
  list.push_back({section, "saturation_time", "ms", &s.saturation_time, 0.0, 1e5,
                  "how long a drive command may be cut to +-10 V", 1e3});
  list.push_back({section, "heartbeat_timeout", "ms", &s.heartbeat_timeout, 5.0, 1e4,
                  "longest silence of the controller before the guard makes the outputs safe",
                  1e3});
  list.push_back({section, "ready_timeout", "ms", &s.ready_timeout, 1.0, 1e5,
                  "from servo on to servo ready", 1e3});
}

void add_realtime(std::vector<Binding>& list, RealtimeSettings& r) {
  const char* section = "realtime";
  list.push_back({section, "priority", "", &r.priority, 0.0, 99.0,
                  "SCHED_FIFO priority of the motion thread; 0 for ordinary scheduling"});
  list.push_back({section, "cpu", "", &r.cpu, -1.0, 1023.0,
                  "CPU that the motion thread stays on; -1 for any"});
  list.push_back(
      {section, "lock_memory", "", &r.lock_memory, 0.0, 0.0, "keep memory from being swapped out"});
  list.push_back({section, "max_late_periods", "", &r.max_late_periods, 1.0, 1e6,
                  "so many late periods in a row end the motion"});
  list.push_back({section, "max_stall", "ms", &r.max_stall, 1.0, 1e5,
                  "one period as late as this ends the motion", 1e3});
}

}  // namespace

std::vector<Binding> safety_bindings(MachineFile& machine) {
  std::vector<Binding> list;
  add_safety(list, machine.safety);
  add_realtime(list, machine.realtime);
  return list;
}

}  // namespace twin::config
