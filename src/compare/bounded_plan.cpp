#include "compare/bounded_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bound/time_bound.hpp"
#include "gcode/reader.hpp"
#include "runtime/planning.hpp"

namespace twin::compare {
namespace {

constexpr int kStepsOfPhase = 8;
constexpr std::size_t kMostRows = 6000;  // of a picture's curve

void add_row(trace::Table& table, double s, double v, double t) {
  table.values.insert(table.values.end(), {s, v, t});
}

/// Adds a segment that begins at s and t, both of which become those of its end.
void add_segment(const feedrate::PlannedSegment& planned, double& s, double& t,
                 trace::Table& profile) {
  if (planned.segment.length <= 0.0) {
    return;
  }
  for (const feedrate::Phase& phase : planned.phases) {
    const int steps = phase.a == 0.0 && phase.j == 0.0 ? 1 : kStepsOfPhase;
    for (int i = 0; i <= steps; ++i) {
      const double at = phase.duration * i / steps;
      const feedrate::PathMotion motion = feedrate::motion_at(phase, at);
      add_row(profile, s + motion.s, std::max(motion.v, 0.0), t + at);
    }
    t += phase.duration;
  }
  s += planned.segment.length;
}

/// Reads times of a profile at ascending places.
class Clock {
 public:
  explicit Clock(const trace::Table& profile) : profile_(profile) {}

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
  const trace::Table& profile_;
  std::size_t row_ = 0;
};

}  // namespace

Expected<BoundedPlan> bounded_plan(const std::filesystem::path& program,
                                   const config::MachineFile& machine,
                                   const std::optional<double>& feedrate, bool has_profiles) {
  auto reader = gcode::Reader::open(program.string(), {.feedrate = feedrate});
  if (!reader) {
    return tl::unexpected(std::move(reader.error()));
  }
  BoundedPlan result{0.0, 0.0, {3, {}}, {3, {}}};
  bound::TimeBound::Profile profile;
  double last_s = 0.0;
  double last_v = 0.0;
  double bound_t = 0.0;
  if (has_profiles) {
    profile = [&](double s, double v) {
      bound_t += s > last_s && v + last_v > 0.0 ? 2.0 * (s - last_s) / (v + last_v) : 0.0;
      add_row(result.bound, s, v, bound_t);
      last_s = s;
      last_v = v;
    };
  }
  bound::TimeBound bound(machine.limits, machine.planning, machine.path, machine.period, profile);
  double s = 0.0;
  double t = 0.0;
  auto figures = runtime::plan_program(*reader, machine, [&](feedrate::PlannedSegment&& planned) {
    bound.add(planned);
    result.deviation = std::max(result.deviation, planned.segment.deviation);
    if (has_profiles) {
      add_segment(planned, s, t, result.planned);
    }
    return true;
  });
  if (!figures) {
    return tl::unexpected(std::move(figures.error()));
  }
  result.time_bound = bound.finish();
  return result;
}

trace::Table lost_time(const BoundedPlan& plan, std::size_t pieces) {
  trace::Table table{2, {}};
  if (plan.planned.rows() < 2 || plan.bound.rows() < 2) {
    return table;
  }
  Clock planned(plan.planned);
  Clock bound(plan.bound);
  const double length = plan.bound.at(plan.bound.rows() - 1, 0);
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double s = length * static_cast<double>(i) / static_cast<double>(pieces);
    const double lost = 1e3 * (planned.at(s) - bound.at(s));
    table.values.insert(table.values.end(), {s, lost});
  }
  return table;
}

trace::Table thinned(const trace::Table& profile) {
  trace::Decimator decimator(2, {1}, kMostRows);
  for (std::size_t i = 0; i < profile.rows(); ++i) {
    decimator.push(profile.row(i).first(2));
  }
  return decimator.finish();
}

}  // namespace twin::compare
