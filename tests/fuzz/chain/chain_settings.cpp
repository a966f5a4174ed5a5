#include <algorithm>

#include "config/rules.hpp"
#include "tests/fuzz/chain/chain_case.hpp"

namespace twin::fuzz {
namespace {

constexpr double kFirRate = 100.0;  // least J / A of the profile fir [1/s]

/// A limit: the usual one, or anything from a hundredth of it to the highest that is allowed.
double limit(ByteSource& bytes, double usual, double highest) {
  switch (bytes.choice(4)) {
    case 0:
      return usual;
    case 1:
      return bytes.log_uniform(0.01 * usual, usual);
    case 2:
      return bytes.log_uniform(usual, highest);
    default:
      return bytes.log_uniform(0.1 * usual, 10.0 * usual);
  }
}

/// Limits of single axes, each for itself; most are none.
void limit_axes(ByteSource& bytes, Limits& limits) {
  const unsigned which = bytes.byte();
  for (Eigen::Index axis = 0; axis < 3 && which >= 128; ++axis) {
    if ((which & 1U) != 0) {
      limits.axis_feedrate[axis] = limits.feedrate * bytes.uniform(0.1, 1.2);
    }
    if ((which & 2U) != 0) {
      limits.axis_acceleration[axis] = limits.acceleration * bytes.uniform(0.1, 1.2);
    }
    if ((which & 4U) != 0) {
      limits.axis_jerk[axis] = limits.jerk * bytes.uniform(0.1, 1.2);
    }
  }
}

/// What only the paper's planner has.
void choose_for_paper(ByteSource& bytes, config::MachineFile& machine) {
  machine.path.planner = Planner::kPaper;
  machine.path.curves = static_cast<CurveKind>(bytes.choice(3));
  machine.planning.feedrate_rule = static_cast<FeedrateRule>(bytes.choice(5));
  machine.planning.tool_radius = bytes.uniform(0.0, 0.1);
  machine.planning.acceleration_profile = static_cast<AccelerationProfile>(bytes.choice(3));
  if (machine.planning.acceleration_profile == AccelerationProfile::kFir) {
    // Its ramps take A / J at least, whatever the change of feedrate.
    machine.limits.jerk = std::max(machine.limits.jerk, kFirRate * machine.limits.acceleration);
  }
}

}  // namespace

config::MachineFile make_settings(ByteSource& bytes) {
  config::MachineFile machine;
  Limits& limits = machine.limits;
  limits.acceleration = limit(bytes, limits.acceleration, 1e6);
  limits.jerk = limit(bytes, limits.jerk, 1e9);
  limits.feedrate = std::min(limit(bytes, limits.feedrate, 1e5 / 60.0), 1e5 / 60.0);
  limits.rapid_feedrate = limits.feedrate * bytes.uniform(0.05, 1.0);
  limit_axes(bytes, limits);
  machine.period = bytes.one_of({1e-3, 1e-3, 1e-3, 5e-4, 2e-3, 4e-3, 2.5e-4, 1.25e-4});
  machine.path.look_ahead = static_cast<int>(bytes.one_of({200, 200, 2, 3, 5, 20, 50, 1000}));
  machine.planning.corner_error = bytes.one_of({0.01, 0.01, 1e-4, 1e-3, 0.1, 1.0});
  machine.path.chord_error = bytes.one_of({0.01, 0.01, 1e-4, 1e-3, 0.1, 1.0});
  machine.path.short_block_length = bytes.one_of({10.0, 10.0, 0.1, 1.0});
  machine.path.max_segments = static_cast<int>(bytes.one_of({20, 20, 3, 100}));
  if (bytes.happens(96)) {
    choose_for_paper(bytes, machine);
  }
  if (bytes.happens(16)) {
    machine.interpolation.update = static_cast<motion::ParameterUpdate>(bytes.choice(4));
    machine.interpolation.curve_end = static_cast<motion::CurveEnd>(bytes.choice(2));
  }
  static_cast<void>(config::resolve_planner(machine));
  return machine;
}

}  // namespace twin::fuzz
