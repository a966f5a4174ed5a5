#include "config/binding.hpp"

// The settings of monitors, correction, uncertainty, shadow and wall clock.
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

void add_compensation(std::vector<Binding>& list, CompensationSettings& c) {
  const char* section = "compensation";
  list.push_back({section, "limit", "mm", &c.limit, 0.0, 1.0,
                  "largest offset that a correction gives an axis"});
  list.push_back(
      {section, "path_tolerance", "mm", &c.path_tolerance, 1e-4, 10.0,
       "corner error of the path of a corrected run, if planning.corner_error is larger"});
  list.push_back({section, "reserve", "percent", &c.reserve, 0.0, 90.0,
                  "of acceleration and jerk, kept from planning for the correction", 100.0});
  list.push_back({section, "highest_frequency", "Hz", &c.highest_frequency, 1.0, 1e4,
                  "above which nothing is corrected"});
}

void add_uncertainty(std::vector<Binding>& list, UncertaintySettings& u) {
  const char* section = "uncertainty";
  list.push_back({section, "inertia", "percent", &u.inertia, 0.0, 50.0,
                  "standard deviation of moving masses that no identification shows", 100.0});
  list.push_back(
      {section, "friction", "percent", &u.friction, 0.0, 50.0, "the same of friction", 100.0});
  list.push_back({section, "loop_gain", "percent", &u.loop_gain, 0.0, 50.0,
                  "the same of gain and integral time of the velocity loop", 100.0});
  list.push_back({section, "delay", "percent", &u.delay, 0.0, 50.0,
                  "the same of current lag and output delay", 100.0});
  list.push_back({section, "offset", "percent", &u.offset, 0.0, 50.0,
                  "the same of the offset of V-REF", 100.0});
}

void add_shadow(std::vector<Binding>& list, ShadowSettings& s) {
  const char* section = "shadow";
  list.push_back({section, "reaction", "", choice(s.stops, {"warn", "stop"}), 0.0, 0.0,
                  "to a change that run --shadow finds: told, or a controlled brake as well"});
  list.push_back(
      {section, "false_alarm", "h", &s.hours, 1e-3, 1e9, "mean time between false alarms"});
  list.push_back({section, "counts", "", &s.reads_counts, 0.0, 0.0,
                  "counts bound the position, which is finer; false: rounding is noise"});
  list.push_back({section, "scale", "", &s.has_scale, 0.0, 0.0,
                  "the table's position in the trace is measured, by a scale of its own"});
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
  add_compensation(list, machine.compensation);
  add_uncertainty(list, machine.uncertainty);
  add_shadow(list, machine.shadow);
  add_realtime(list, machine.realtime);
  return list;
}

}  // namespace twin::config
