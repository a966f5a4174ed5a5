#include "path/path_builder.hpp"

#include <algorithm>
#include <utility>

#include "gcode/block.hpp"
#include "geometry/nurbs/refine.hpp"
#include "path/short_block.hpp"

namespace twin::path {

namespace {

/// What a segment takes over from its block.
void set_demands(Segment& segment, const gcode::Block& block, const Limits& limits,
                 const PlanningModel& model) {
  segment.is_rapid = block.motion == gcode::Motion::kRapid;
  segment.feedrate =
      segment.is_rapid ? limits.rapid_feedrate : std::min(block.feedrate, limits.feedrate);
  segment.corner_error = block.tolerance > 0.0 ? block.tolerance : model.corner_error;
  segment.stops_at_end = block.path_mode == gcode::PathMode::kExactStop;
}

}  // namespace

Segment make_segment(const gcode::Block& block, std::int64_t number, const Limits& limits,
                     const PlanningModel& model) {
  Segment segment;
  set_demands(segment, block, limits, model);
  if (block.motion == gcode::Motion::kDwell) {
    segment.dwell = block.dwell;
    segment.stops_at_end = true;
    segment.begin.position = segment.end.position = block.start;
  } else if (block.motion == gcode::Motion::kArc) {
    const Arc arc = make_arc(block.arc);
    segment.length = arc.length;
    segment.begin = point_at(arc, 0.0);
    segment.end = point_at(arc, arc.length);
    segment.geometry = arc;
  } else {
    const Vec3 way = block.end - block.start;
    segment.length = way.norm();
    const Line line{block.start, way / segment.length};
    segment.begin = point_at(line, 0.0);
    segment.end = point_at(line, segment.length);
    segment.geometry = line;
  }
  segment.marks.push_back({segment.length, segment.length, number, block.line});
  return segment;
}

std::vector<FittedCurve> make_nurbs_curves(const gcode::Block& block, int most_spans) {
  constexpr int kSmooth = 2;  // derivatives that are continuous
  std::vector<FittedCurve> curves;
  for (geometry::Curve& piece : geometry::split(block.nurbs->curve, {kSmooth, most_spans})) {
    FittedCurve given;
    given.curve = std::move(piece);
    given.is_programmed = true;
    measure(given);
    curves.push_back(std::move(given));
  }
  return curves;
}

std::vector<Segment> make_nurbs_segments(const gcode::Block& block, std::int64_t number,
                                         int most_spans, const Limits& limits,
                                         const PlanningModel& model) {
  std::vector<Segment> segments;
  for (FittedCurve& given : make_nurbs_curves(block, most_spans)) {
    Segment segment = make_curve_segment(std::move(given));
    set_demands(segment, block, limits, model);
    segment.marks.push_back({segment.length, segment.length, number, block.line});
    segments.push_back(std::move(segment));
  }
  return segments;
}

PathBuilder::PathBuilder(const PathSettings& settings, const PlanningModel& model,
                         const Limits& limits, Sink sink)
    : settings_(settings),
      model_(model),
      limits_(limits),
      sink_(std::move(sink)),
      run_(settings, model, limits, sink_) {}

bool PathBuilder::is_short(const gcode::Block& block) const {
  return settings_.curves != CurveKind::kNone && block.motion == gcode::Motion::kLinear &&
         block.path_mode == gcode::PathMode::kContinuous &&
         (block.end - block.start).norm() <= settings_.short_block_length;
}

bool PathBuilder::continues_run(const gcode::Block& block) const {
  if (run_.is_empty() || block.tolerance != last_.tolerance) {
    return false;
  }
  const double corner_error = block.tolerance > 0.0 ? block.tolerance : model_.corner_error;
  const double chord_error = block.tolerance > 0.0 ? block.tolerance : settings_.chord_error;
  const double feedrate = std::min(std::max(block.feedrate, last_.feedrate), limits_.feedrate);
  return corner_angle(last_.start, block.start, block.end) >=
             critical_corner_angle(feedrate, corner_error, model_) &&
         bi_chord_error(last_.start, block.start, block.end) <= chord_error;
}

void PathBuilder::push(const gcode::Block& block) {
  const std::int64_t number = next_block_++;
  if (block.motion == gcode::Motion::kNurbs) {
    run_.finish();
    for (Segment& segment :
         make_nurbs_segments(block, number, settings_.max_segments, limits_, model_)) {
      sink_(std::move(segment));
    }
    return;
  }
  if (!is_short(block)) {
    run_.finish();
    sink_(make_segment(block, number, limits_, model_));
    return;
  }
  if (!continues_run(block)) {
    run_.finish();
  }
  run_.push(block, number);
  last_ = block;
}

void PathBuilder::finish() { run_.finish(); }

}  // namespace twin::path
