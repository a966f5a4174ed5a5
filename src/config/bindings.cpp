#include <algorithm>
#include <iterator>

#include "config/binding.hpp"
#include "core/units.hpp"

// The list of settings. A new setting is a new line here, and nowhere else.
namespace twin::config {
namespace {

using List = std::vector<Binding>;

constexpr double kPerMinute = units::mm_per_min_from_mm_per_s(1.0);

void add_program(List& list, ProgramSettings& p) {
  const char* section = "program";
  list.push_back({section, "dialect", "",
                  choice(p.dialect, {kDialectNames.begin(), kDialectNames.end()}), 0.0, 0.0,
                  "whose language programs are written in, where controls differ"});
  list.push_back({section, "ignored_axes", "", &p.ignored_axes, 0.0, 0.0,
                  "letters of A B C E U V W whose words are left out"});
  list.push_back({section, "default_feedrate", "mm_per_min", &p.default_feedrate, 0.0, 1e5,
                  "of feed moves without an F; 0: they are refused", kPerMinute});
  list.push_back({section, "parameters", "", &p.parameters, 0.0, 0.0,
                  "values of parameters at the start, as \"#100 = 5, _hal[a.b] = 1\""});
  list.push_back({section, "workpiece", "mm", &p.workpiece, -1e4, 1e4,
                  "where the origin of a program's coordinates lies (x, y, z)"});
  list.push_back({section, "start", "mm", &p.start, -1e4, 1e4,
                  "where the machine stands when a program begins (x, y, z)"});
  list.push_back(
      {section, "lifts_start", "", &p.lifts_start, 0.0, 0.0,
       "with start z = 0: a program that begins with a rapid across starts at the height "
       "of its rapids"});
  list.push_back({section, "tool_table", "", &p.tool_table, 0.0, 0.0,
                  "file with lengths and diameters of tools, as LinuxCNC has it; empty: none"});
  list.push_back({section, "skips_deleted", "", &p.skips_deleted, 0.0, 0.0,
                  "lines that begin with / are left out"});
  list.push_back({section, "most_lines", "", &p.most_lines, 1.0, 2e9,
                  "lines that loops and calls may execute again"});
}

void add_limits(List& list, Limits& l) {
  const char* section = "limits";
  list.push_back({section, "feedrate", "mm_per_min", &l.feedrate, 1.0, 1e5,
                  "largest feedrate the machine accepts", kPerMinute});
  list.push_back({section, "rapid_feedrate", "mm_per_min", &l.rapid_feedrate, 1.0, 1e5,
                  "feedrate of G00", kPerMinute});
  list.push_back({section, "acceleration", "mm_per_s2", &l.acceleration, 1.0, 1e6,
                  "A_max, tangential and normal, each"});
  list.push_back({section, "jerk", "mm_per_s3", &l.jerk, 1.0, 1e9, "J_max"});
  list.push_back(
      {section, "jerk_of", "", choice(l.jerk_of, {kJerkOfNames.begin(), kJerkOfNames.end()}), 0.0,
       0.0, "what J_max bounds: the jerk along the path, or that of the position as a vector"});
  list.push_back({section, "axis_feedrate", "mm_per_min", &l.axis_feedrate, 0.0, 1e6,
                  "largest feedrate of each axis, x y z; 0: no limit of its own", kPerMinute});
  list.push_back({section, "axis_acceleration", "mm_per_s2", &l.axis_acceleration, 0.0, 1e6,
                  "acceleration limit of each axis, x y z; 0: no limit of its own"});
  list.push_back({section, "axis_jerk", "mm_per_s3", &l.axis_jerk, 0.0, 1e9,
                  "jerk limit of each axis, x y z; 0: no limit of its own"});
  list.push_back(
      {section, "travel_min", "mm", &l.travel_min, -1e5, 1e5, "lower ends of travel, x y z"});
  list.push_back(
      {section, "travel_max", "mm", &l.travel_max, -1e5, 1e5, "upper ends of travel, x y z"});
}

void add_planning(List& list, PlanningModel& p, PathSettings& s) {
  const char* section = "planning";
  list.push_back({section, "planner", "",
                  choice(s.planner, {kPlannerNames.begin(), kPlannerNames.end()}), 0.0, 0.0,
                  "what makes path and feedrates"});
  list.push_back({section, "corners", "",
                  choice(s.corners, {kCornerNames.begin(), kCornerNames.end()}), 0.0, 0.0,
                  "how corners between lines are passed where the jerk has limits as a vector or "
                  "of each axis"});
  list.push_back(
      {section, "kp", "per_s", &p.kp, 1e-3, 1e5, "position gain Kp the planner believes in"});
  list.push_back({section, "kf", "", &p.kf, 0.0, 0.999,
                  "velocity feedforward gain Kf the planner believes in"});
  list.push_back({section, "circular_error", "mm", &p.circular_error, 1e-6, 10.0,
                  "circular contouring error, Eq. 4"});
  list.push_back(
      {section, "corner_error", "mm", &p.corner_error, 1e-6, 10.0, "corner error, Eqs. 1 and 16"});
  list.push_back({section, "critical_feedrate", "mm_per_min", &p.critical_feedrate, 1.0, 1e6,
                  "certified planner: tighter bends than A_max / V^2 keep the circular error",
                  kPerMinute});
  list.push_back({section, "chord_error", "mm", &s.chord_error, 1e-6, 10.0,
                  "chord tolerance; a curve's distance from the polygon"});
  list.push_back(
      {section, "feedrate_rule", "",
       choice(p.feedrate_rule, {"auto", "constant", "chord_error", "servo_model", "contact_speed"}),
       0.0, 0.0, "what limits the feedrate on arcs and curves"});
  list.push_back({section, "tool_radius", "mm", &p.tool_radius, 0.0, 1e3,
                  "tool radius; for contact_speed only"});
  list.push_back({section, "tool_side", "", choice(p.tool_side, {"left", "right"}), 0.0, 0.0,
                  "side of the surface on which the tool is, G41 or G42; for contact_speed only"});
  list.push_back({section, "acceleration_profile", "",
                  choice(p.acceleration_profile, {"trapezoidal", "s_curve", "fir"}), 0.0, 0.0,
                  "how the feedrate changes from one value to another"});
  list.push_back({section, "min_segments", "", &s.min_segments, 2.0, 1e3,
                  "fewest blocks fitted into one curve"});
  list.push_back(
      {section, "max_segments", "", &s.max_segments, 2.0, 1e3, "most blocks in one curve"});
  list.push_back({section, "short_block_length", "mm", &s.short_block_length, 1e-3, 1e4,
                  "a longer block is no short one"});
  list.push_back({section, "look_ahead", "", &s.look_ahead, 2.0, 1e5,
                  "planned segments between planner and interpolator"});
}

void add_path(List& list, CurveKind& curves) {
  list.push_back({"path", "curves", "", choice(curves, {kCurveNames.begin(), kCurveNames.end()}),
                  0.0, 0.0, "what runs of short blocks become", 1.0, "interpolator.kind"});
}

void add_interpolator(List& list, motion::InterpolatorSettings& i, double& period) {
  const char* section = "interpolator";
  list.push_back({section, "period", "ms", &period, 0.125, 4.0, "time between set points", 1e3});
  list.push_back({section, "parameter_update", "",
                  choice(i.update, {"taylor1", "taylor2", "rk4", "corrected"}), 0.0, 0.0,
                  "how the parameter of a curve goes on from period to period"});
  list.push_back({section, "curve_end", "", choice(i.curve_end, {"carry", "land"}), 0.0, 0.0,
                  "at the end of a curve: carry the remainder over, or land on the end"});
}

void add_servo(List& list, const std::string& section, motion::Gains& g) {
  list.push_back({section, "kp", "per_s", &g.kp, 0.0, 1e5, "position gain"});
  list.push_back({section, "kd", "", &g.kd, -1e3, 1e3, "derivative gain"});
  list.push_back({section, "kf", "", &g.kf, -10.0, 10.0, "velocity feedforward"});
  list.push_back({section, "ka", "s", &g.ka, -1.0, 1.0, "acceleration feedforward"});
  list.push_back({section, "trim", "V", &g.trim_V, -10.0, 10.0,
                  "added to the drive command against its offset"});
  list.push_back(
      {section, "kv", "", &g.kv, 0.0, 1e3, "velocity feedback, for a drive in torque mode"});
  list.push_back({section, "kv_periods", "", &g.kv_periods, 1, motion::kMostVelocityPeriods,
                  "over which the measured velocity is a mean"});
  list.push_back({section, "command_delay", "ms", &g.command_delay, 0.0, 50.0,
                  "how late the set point reaches the position loop", 1e3});
}

void add_home(List& list, const std::string& section, HomeSettings& home) {
  list.push_back({section, "switch", "", choice(home.is_positive, {"n-ot", "p-ot"}), 0.0, 0.0,
                  "limit switch that is sought"});
  list.push_back({section, "seek_feedrate", "mm_per_min", &home.seek_feedrate, 1.0, 6000.0,
                  "towards the switch, and to zero afterwards", kPerMinute});
  list.push_back({section, "index_feedrate", "mm_per_min", &home.index_feedrate, 1.0, 600.0,
                  "off the switch and to the index", kPerMinute});
  list.push_back(
      {section, "zero", "mm", &home.zero, -1e4, 1e4, "from the index to the axis' zero, signed"});
}

}  // namespace

std::vector<Binding> bindings(MachineFile& machine) {
  List list;
  add_program(list, machine.program);
  add_limits(list, machine.limits);
  add_planning(list, machine.planning, machine.path);
  add_path(list, machine.path.curves);
  add_interpolator(list, machine.interpolation, machine.period);
  add_servo(list, "servo.x", machine.servo[hal::kX]);
  add_servo(list, "servo.y", machine.servo[hal::kY]);
  for (List part :
       {safety_bindings(machine), table_bindings(machine.table), rig_bindings(machine.rig)}) {
    std::ranges::move(part, std::back_inserter(list));
  }
  add_home(list, "home.x", machine.home[hal::kX]);
  add_home(list, "home.y", machine.home[hal::kY]);
  return list;
}

}  // namespace twin::config
