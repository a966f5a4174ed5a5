#include "tests/fuzz/chain/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/set_points.hpp"

namespace twin::fuzz {
namespace {

constexpr double kMostTimes = 4.0;  // of the reference time
/// The same with the paper's planner: a curve that it fits through specks beside long blocks may be some ten times as
/// long as its blocks.
constexpr double kMostTimesOfPaper = 40.0;
constexpr double kMostMore = 2000.0;      // [periods]
constexpr std::size_t kRestPeriods = 40;  // so many equal set points in a hold are a rest

/// Time that the edge of a tool takes around all turns of the program at the programmed feedrates: it
/// moves on a circle of the tool's radius there, while the centre hardly moves [s].
double edge_time(const Case& made) {
  double time = 0.0;
  Vec3 before = Vec3::Zero();
  for (const Piece& piece : made.program.pieces) {
    const std::vector<Vec3>& points = piece.shape.points;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Vec3 step = points[i] - points[i - 1];
      if (before.squaredNorm() > 0.0 && step.squaredNorm() > 0.0) {
        const double turn = std::atan2(before.cross(step).norm(), before.dot(step));
        time += turn * made.machine.planning.tool_radius / piece.feedrate;
      }
      before = step.squaredNorm() > 0.0 ? step : before;
    }
  }
  return time;
}

std::size_t most_steps(const Case& made) {
  double lowest = 100.0;
  double end = 0.0;  // [s]
  for (const runtime::OverrideChange& change : made.operations) {
    lowest = change.percent > 0.0 ? std::min(lowest, change.percent) : lowest;
    end = change.time;
  }
  const bool is_contact = made.machine.planning.feedrate_rule == FeedrateRule::kContactSpeed;
  const double least = made.reference_time + (is_contact ? edge_time(made) : 0.0);
  const bool is_paper = made.machine.path.planner == Planner::kPaper;
  const double times = is_paper ? kMostTimesOfPaper : kMostTimes;
  const double time = times * least * 100.0 / lowest + end;
  return static_cast<std::size_t>(time / made.machine.period + kMostMore);
}

bool rests(const std::vector<Vec3>& points) {
  return points.size() > kRestPeriods &&
         std::all_of(points.end() - kRestPeriods, points.end(),
                     [&](const Vec3& point) { return point == points.back(); });
}

}  // namespace

Trajectory follow(const Case& made) {
  Trajectory out;
  const auto source = runtime::SetPoints::open(
      gcode::ProgramText::from_text(made.program.text, "fuzz.nc"), made.machine);
  const std::size_t most = most_steps(made);
  std::size_t next = 0;  // of the operations
  bool is_held = false;
  motion::SetPoint point;
  while (out.points.size() < most) {
    for (; next < made.operations.size() && made.operations[next].time <= source->time(); ++next) {
      is_held = made.operations[next].percent == 0.0;
      source->set_override(made.operations[next].percent);
    }
    if (!source->next(point)) {
      out.ending = source->error() ? Ending::kRefused : Ending::kWhole;
      out.error = source->error() ? to_string(*source->error()) : "";
      return out;
    }
    out.points.push_back(point.position);
    out.lines.push_back(point.line);
    if (is_held && next == made.operations.size() && rests(out.points)) {
      out.ending = Ending::kStopped;
      return out;
    }
  }
  return out;
}

}  // namespace twin::fuzz
