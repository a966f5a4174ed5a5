#include "studies/compare/bounded_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "feedrate/bound/time_bound.hpp"
#include "gcode/reader.hpp"
#include "runtime/planning.hpp"
#include "runtime/run_options.hpp"

namespace twin::studies::compare {
namespace {

constexpr double kStepOfFeedrate = 1.0;  // between two rows of a phase, about [mm/s]
constexpr double kMostSteps = 8.0;       // of a phase

/// Adds a row, unless it repeats the last.
void add_row(results::Table& table, double s, double v, double t) {
  const std::size_t rows = table.rows();
  if (rows > 0 && table.at(rows - 1, 0) == s && table.at(rows - 1, 1) == v) {
    return;
  }
  table.values.insert(table.values.end(), {s, v, t});
}

/// Adds a segment that begins at s and t, both of which become those of its end.
void add_segment(const feedrate::PlannedSegment& planned, double& s, double& t,
                 results::Table& profile) {
  if (planned.segment.length <= 0.0) {
    return;
  }
  for (const feedrate::Phase& phase : planned.phases) {
    const double change = feedrate::motion_at(phase, phase.duration).v - phase.v;
    const double wanted = std::ceil(std::abs(change) / kStepOfFeedrate);
    const int steps = static_cast<int>(std::clamp(wanted, 1.0, kMostSteps));
    for (int i = 0; i <= steps; ++i) {
      const double at = phase.duration * i / steps;
      const feedrate::PathMotion motion = feedrate::motion_at(phase, at);
      add_row(profile, s + motion.s, std::max(motion.v, 0.0), t + at);
    }
    t += phase.duration;
  }
  s += planned.segment.length;
}

/// Feedrate just before a row, v^2 linear over s since the row before it.
double feedrate_at(const results::Table& profile, std::size_t row, double s) {
  if (row == 0) {
    return profile.at(0, 1);
  }
  const double s0 = profile.at(row - 1, 0);
  const double v0 = profile.at(row - 1, 1);
  const double v1 = profile.at(row, 1);
  const double length = profile.at(row, 0) - s0;
  const double x = length > 0.0 ? std::clamp((s - s0) / length, 0.0, 1.0) : 1.0;
  return std::sqrt(v0 * v0 + x * (v1 * v1 - v0 * v0));
}

/// Reads times of a profile at ascending places.
class Clock {
 public:
  explicit Clock(const results::Table& profile) : profile_(profile) {}

  double at(double s) {
    while (row_ + 2 < profile_.rows() && profile_.at(row_ + 1, 0) < s) {
      ++row_;
    }
    const double s0 = profile_.at(row_, 0);
    const double v0 = profile_.at(row_, 1);
    const double v1 = profile_.at(row_ + 1, 1);
    const double length = profile_.at(row_ + 1, 0) - s0;
    if (length <= 0.0) {
      return profile_.at(row_ + 1, 2);
    }
    const double x = std::clamp((s - s0) / length, 0.0, 1.0);
    const double sum = v0 + std::sqrt(v0 * v0 + x * (v1 * v1 - v0 * v0));
    const double share = sum > 0.0 ? x * (v0 + v1) / sum : 0.0;
    return profile_.at(row_, 2) + share * (profile_.at(row_ + 1, 2) - profile_.at(row_, 2));
  }

 private:
  const results::Table& profile_;
  std::size_t row_ = 0;
};

}  // namespace

Expected<BoundedPlan> bounded_plan(const gcode::ProgramText& program,
                                   const config::MachineFile& machine,
                                   const std::optional<double>& feedrate, Profiles profiles) {
  gcode::Reader reader(program, runtime::reader_options(machine, feedrate));
  BoundedPlan result{.planned = {3, {}}, .bound = {3, {}}};
  feedrate::TimeBound::Profile profile;
  double last_s = 0.0;
  double last_v = 0.0;
  double bound_t = 0.0;
  if (profiles == Profiles::kRecorded) {
    profile = [&](double s, double v) {
      bound_t += s > last_s && v + last_v > 0.0 ? 2.0 * (s - last_s) / (v + last_v) : 0.0;
      add_row(result.bound, s, v, bound_t);
      last_s = s;
      last_v = v;
    };
  }
  feedrate::TimeBound bound(machine.limits, machine.planning, machine.path, machine.period,
                            profile);
  double s = 0.0;
  double t = 0.0;
  TWIN_CHECK(runtime::plan_program(reader, machine, [&](feedrate::PlannedSegment&& planned) {
    bound.add(planned);
    if (profiles == Profiles::kRecorded) {
      add_segment(planned, s, t, result.planned);
    }
    return true;
  }));
  result.time_bound = bound.finish();
  result.time_bound_with_jerk = bound.with_jerk();
  return result;
}

results::Table lost_time(const BoundedPlan& plan, std::size_t pieces) {
  results::Table table{2, {}};
  if (plan.planned.rows() < 2 || plan.bound.rows() < 2) {
    return table;
  }
  Clock planned(plan.planned);
  Clock bound(plan.bound);
  const double length = plan.bound.at(plan.bound.rows() - 1, 0);
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double s = length * static_cast<double>(i) / static_cast<double>(pieces);
    table.values.insert(table.values.end(), {s, planned.at(s) - bound.at(s)});
  }
  return table;
}

results::Table thinned(const results::Table& profile, std::size_t pieces) {
  results::Table thin{2, {}};
  if (profile.rows() < 2) {
    return thin;
  }
  const auto add = [&](double s, double v) { thin.values.insert(thin.values.end(), {s, v}); };
  const double first = profile.at(0, 0);
  const double piece = (profile.at(profile.rows() - 1, 0) - first) / static_cast<double>(pieces);
  std::size_t row = 0;
  for (std::size_t i = 0; i < pieces; ++i) {
    const double begin = first + piece * static_cast<double>(i);
    add(begin, feedrate_at(profile, row, begin));
    std::size_t low = row;
    std::size_t high = row;
    const std::size_t from = row;
    for (; row + 1 < profile.rows() && profile.at(row, 0) <= begin + piece; ++row) {
      low = profile.at(row, 1) < profile.at(low, 1) ? row : low;
      high = profile.at(row, 1) > profile.at(high, 1) ? row : high;
    }
    if (row > from) {
      for (const std::size_t kept : {std::min(low, high), std::max(low, high)}) {
        add(profile.at(kept, 0), profile.at(kept, 1));
      }
    }
  }
  add(profile.at(profile.rows() - 1, 0), profile.at(profile.rows() - 1, 1));
  return thin;
}

}  // namespace twin::studies::compare
