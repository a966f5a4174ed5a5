#include "path/smooth_builder.hpp"

#include <algorithm>
#include <utility>

#include "path/path_builder.hpp"
#include "path/short_block.hpp"

namespace twin::path {
namespace {

/// Share of the tolerance by which the path may move where lines are left out. CAM systems leave
/// lines of a micrometre behind whose directions are rounding only. A larger share leaves out more
/// of them, and less of the tolerance remains for corners and runs.
constexpr double kSpeck = 0.01;
constexpr double kLargestSpeck = 1e-3;  // whatever the tolerance [mm]

/// Limits of axes and of the jerk as a vector depend on how the curvature changes along a curve.
geometry::Sampling sampling_for(const Limits& limits) {
  const bool has_changes = limits.jerk_of == JerkOf::kVector ||
                           !limits.axis_acceleration.isZero() || !limits.axis_jerk.isZero();
  return has_changes ? geometry::Sampling::kEven : geometry::Sampling::kSparse;
}

}  // namespace

SmoothBuilder::SmoothBuilder(const PathSettings& settings, const PlanningModel& model,
                             const Limits& limits, Sink sink, std::unique_ptr<CornerJudge> judge)
    : settings_(settings),
      model_(model),
      limits_(limits),
      judge_(std::move(judge)),
      writer_(std::move(sink), sampling_for(limits)),
      joiner_(writer_, limits, settings.corners, judge_.get()),
      run_(joiner_) {}

/// What is left of the tolerance at corners, less that of the specks.
double SmoothBuilder::corner_tolerance(double programmed) const {
  return (1.0 - kSpeck) * (programmed > 0.0 ? programmed : model_.corner_error);
}

double SmoothBuilder::run_tolerance(double programmed) const {
  return (1.0 - kSpeck) *
         (programmed > 0.0 ? programmed : std::min(settings_.chord_error, model_.corner_error));
}

bool SmoothBuilder::continues_run(const LineBlock& line) const {
  return !run_.is_empty() && line.tolerance == last_.tolerance && last_.can_be_short &&
         line.can_be_short &&
         is_bi_chord_within(last_.start, line.start, line.end, run_tolerance(line.tolerance));
}

BlockDemand SmoothBuilder::demand_of(const gcode::Block& block, double length,
                                     std::int64_t number) const {
  BlockDemand demand;
  demand.length = length;
  demand.number = number;
  demand.line = block.line;
  demand.is_rapid = block.motion == gcode::Motion::kRapid;
  demand.feedrate =
      demand.is_rapid ? limits_.rapid_feedrate : std::min(block.feedrate, limits_.feedrate);
  demand.corner_error = block.tolerance > 0.0 ? block.tolerance : model_.corner_error;
  return demand;
}

bool SmoothBuilder::is_short(const gcode::Block& block, double length) const {
  return block.motion == gcode::Motion::kLinear && length <= settings_.short_block_length;
}

/// Leaves a block out if it is a speck: it ends where the latest line ends. If that line is one, it is
/// left out instead, and the block is the line.
/// @returns whether the block was left out
bool SmoothBuilder::merge_into_line(const gcode::Block& block, const BlockDemand& demand) {
  const double speck = std::min(0.5 * kSpeck * run_tolerance(block.tolerance), kLargestSpeck);
  if (!has_line_ || block.tolerance != line_.tolerance) {
    return false;
  }
  const double away = block.start == line_.end ? demand.length : (block.end - line_.end).norm();
  if (line_.length > speck && away > speck) {
    return false;
  }
  line_.last = block.end;
  if (line_.length > speck) {
    line_.left_out.push_back(demand);
    line_.left_out.back().deviation = away;
    return true;
  }
  // The line is a speck itself: it ends where it begins, and the block begins there.
  line_.demand.deviation = std::max(line_.demand.deviation, line_.length);
  line_.before.push_back(line_.demand);
  line_.before.insert(line_.before.end(), line_.left_out.begin(), line_.left_out.end());
  line_.left_out.clear();
  line_.demand = demand;
  line_.demand.deviation = (block.start - line_.start).norm();
  line_.end = block.end;
  line_.length = (line_.end - line_.start).norm();
  line_.can_be_short = is_short(block, line_.length);
  return true;
}

void SmoothBuilder::add_line(const gcode::Block& block, std::int64_t number) {
  const double programmed = (block.end - block.start).norm();
  BlockDemand demand = demand_of(block, programmed, number);
  if (merge_into_line(block, demand)) {
    return;
  }
  const Vec3 start = has_line_ && block.tolerance == line_.tolerance ? line_.end : block.start;
  end_line(start != line_.end ? Following::kOther : Following::kConnected);
  line_.start = start;
  line_.end = line_.last = block.end;
  const bool is_as_programmed = start == block.start;
  line_.length = is_as_programmed ? programmed : (line_.end - line_.start).norm();
  line_.tolerance = block.tolerance;
  line_.can_be_short = is_short(block, line_.length);
  demand.deviation = is_as_programmed ? 0.0 : (block.start - start).norm();
  line_.demand = demand;
  line_.before.clear();
  line_.left_out.clear();
  has_line_ = true;
}

/// Emits the latest line. Where nothing follows that begins at its own end, it goes on to the end
/// of the blocks that were left out behind it.
void SmoothBuilder::end_line(Following following) {
  if (!has_line_) {
    return;
  }
  if (following == Following::kOther && line_.last != line_.end) {
    line_.demand.deviation += (line_.last - line_.end).norm();
    line_.end = line_.last;
    line_.length = (line_.end - line_.start).norm();
  }
  has_line_ = false;
  emit_line(line_);
}

void SmoothBuilder::emit_line(LineBlock& line) {
  if (!continues_run(line)) {
    run_.finish();
    joiner_.set_demands(corner_tolerance(line.tolerance), line.demand.feedrate);
    run_.start(line.start, length_, run_tolerance(line.tolerance));
  }
  for (BlockDemand& demand : line.before) {
    demand.end = length_;
    writer_.add_block(demand);
  }
  length_ += line.length;
  line.demand.end = length_;
  writer_.add_block(line.demand);
  for (BlockDemand& demand : line.left_out) {
    demand.end = length_;
    writer_.add_block(demand);
  }
  if (line.length > 0.0) {
    run_.push(line.end);
  }
  last_.start = line.start;
  last_.tolerance = line.tolerance;
  last_.can_be_short = line.can_be_short;
}

void SmoothBuilder::end_lines() {
  end_line(Following::kOther);
  run_.finish();
}

void SmoothBuilder::push_arc(const gcode::Block& block, std::int64_t number) {
  end_lines();
  const Arc arc = make_arc(block.arc);
  BlockDemand demand = demand_of(block, arc.length, number);
  joiner_.set_demands(corner_tolerance(block.tolerance), demand.feedrate);
  const double begin = length_;
  length_ += arc.length;
  demand.end = length_;
  writer_.add_block(demand);
  joiner_.take_arc(arc, begin);
}

void SmoothBuilder::push_nurbs(const gcode::Block& block, std::int64_t number) {
  end_lines();
  auto curves = make_nurbs_curves(block, settings_.max_segments);
  double length = 0.0;
  for (const FittedCurve& curve : curves) {
    length += curve.arc_length.length();
  }
  BlockDemand demand = demand_of(block, length, number);
  joiner_.set_demands(corner_tolerance(block.tolerance), demand.feedrate);
  double begin = length_;
  length_ += length;
  demand.end = length_;
  writer_.add_block(demand);
  for (FittedCurve& curve : curves) {
    const double end = begin + curve.arc_length.length();
    joiner_.take_curve(std::move(curve), begin);
    begin = end;
  }
}

void SmoothBuilder::push(const gcode::Block& block) {
  const std::int64_t number = next_block_++;
  const bool is_exact_stop = block.path_mode == gcode::PathMode::kExactStop;
  if (block.motion == gcode::Motion::kNurbs && !is_exact_stop) {
    push_nurbs(block, number);
  } else if (block.motion == gcode::Motion::kNurbs) {
    for (Segment& segment :
         make_nurbs_segments(block, number, settings_.max_segments, limits_, model_)) {
      emit_whole(std::move(segment));
    }
  } else if (block.motion == gcode::Motion::kDwell || is_exact_stop) {
    emit_whole(make_segment(block, number, limits_, model_));
  } else if (block.motion == gcode::Motion::kArc) {
    push_arc(block, number);
  } else {
    add_line(block, number);
  }
}

/// A segment that nothing is joined to.
void SmoothBuilder::emit_whole(Segment&& segment) {
  end_lines();
  joiner_.finish();
  writer_.whole(std::move(segment));
}

void SmoothBuilder::finish() {
  end_lines();
  joiner_.finish();
  if (writer_.is_empty() && next_block_ > 0) {
    writer_.whole(rest_at_start());
  }
  writer_.finish();
}

/// What is left of a program whose blocks are all specks that lead back to where it starts.
Segment SmoothBuilder::rest_at_start() const {
  Segment rest;
  rest.stops_at_end = true;
  rest.begin.position = rest.end.position = line_.start;
  rest.marks.push_back({0.0, line_.demand.length, line_.demand.number, line_.demand.line});
  return rest;
}

}  // namespace twin::path
