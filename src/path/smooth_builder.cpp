#include "path/smooth_builder.hpp"

#include <algorithm>
#include <utility>

#include "gcode/programmed_curve.hpp"
#include "nurbs/refine.hpp"
#include "path/curve_segment.hpp"
#include "path/path_builder.hpp"
#include "path/short_block.hpp"

namespace twin::path {
namespace {

constexpr double kSagittaShare = 1.0;  // of the tolerance, at a smooth vertex

}  // namespace

SmoothBuilder::SmoothBuilder(const PathSettings& settings, const PlanningModel& model,
                             const Limits& limits, Sink sink)
    : settings_(settings),
      model_(model),
      limits_(limits),
      writer_(std::move(sink)),
      joiner_(writer_),
      run_(joiner_) {}

double SmoothBuilder::corner_tolerance(const gcode::Block& block) const {
  return block.tolerance > 0.0 ? block.tolerance : model_.corner_error;
}

double SmoothBuilder::run_tolerance(const gcode::Block& block) const {
  return block.tolerance > 0.0 ? block.tolerance
                               : std::min(settings_.chord_error, model_.corner_error);
}

bool SmoothBuilder::is_short(const gcode::Block& block) const {
  return settings_.curves != CurveKind::kNone && block.motion == gcode::Motion::kLinear &&
         (block.end - block.start).squaredNorm() <=
             settings_.short_block_length * settings_.short_block_length;
}

bool SmoothBuilder::continues_run(const gcode::Block& block) const {
  return !run_.is_empty() && block.tolerance == last_.tolerance && is_short(last_) &&
         is_short(block) &&
         bi_chord_error(last_.start, block.start, block.end) <=
             kSagittaShare * run_tolerance(block);
}

/// The block's demands, and the base path length at its end.
double SmoothBuilder::add_block(const gcode::Block& block, double length, std::int64_t number) {
  BlockDemand demand;
  demand.end = length_ + length;
  demand.length = length;
  demand.number = number;
  demand.line = block.line;
  demand.is_rapid = block.motion == gcode::Motion::kRapid;
  demand.feedrate =
      demand.is_rapid ? limits_.rapid_feedrate : std::min(block.feedrate, limits_.feedrate);
  demand.corner_error = corner_tolerance(block);
  writer_.add_block(demand);
  return demand.end;
}

void SmoothBuilder::push_line(const gcode::Block& block, std::int64_t number) {
  const double length = (block.end - block.start).norm();
  if (!continues_run(block)) {
    run_.finish();
    joiner_.set_tolerance(corner_tolerance(block));
    run_.start(block.start, length_, run_tolerance(block));
  }
  length_ = add_block(block, length, number);
  run_.push(block.end);
  last_ = block;
}

void SmoothBuilder::push(const gcode::Block& block) {
  const std::int64_t number = next_block_++;
  if (block.motion == gcode::Motion::kNurbs) {
    push_nurbs(block, number);
  } else if (block.motion == gcode::Motion::kDwell ||
             block.path_mode == gcode::PathMode::kExactStop) {
    put_whole(make_segment(block, number, limits_, model_));
  } else if (block.motion == gcode::Motion::kArc) {
    run_.finish();
    joiner_.set_tolerance(corner_tolerance(block));
    const Arc arc = make_arc(block.arc);
    const double begin = length_;
    length_ = add_block(block, arc.length, number);
    joiner_.take_arc(arc, begin);
  } else {
    push_line(block, number);
  }
}

/// A segment that nothing is joined to.
void SmoothBuilder::put_whole(Segment&& segment) {
  run_.finish();
  joiner_.finish();
  writer_.whole(std::move(segment));
}

/// Pieces of at most max_segments spans, cut where the curvature jumps or the tangent turns.
void SmoothBuilder::push_nurbs(const gcode::Block& block, std::int64_t number) {
  for (Segment& segment :
       make_nurbs_segments(block, number, settings_.max_segments, limits_, model_)) {
    put_whole(std::move(segment));
  }
}

void SmoothBuilder::finish() {
  run_.finish();
  joiner_.finish();
  writer_.finish();
}

}  // namespace twin::path
