#include "path/run_fitter.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "geometry/nurbs/deviation.hpp"
#include "path/path_builder.hpp"

namespace twin::path {
namespace {

/// Points on either side of a joint that decide its derivatives. The effect of the farthest is
/// 0.27^6 of that of the nearest, 0.04 %. Each further point delays the curve by a block.
constexpr std::size_t kJointPoints = 6;

}  // namespace

RunFitter::RunFitter(const PathSettings& settings, const PlanningModel& model, Limits limits,
                     Sink sink)
    : settings_(settings), model_(model), limits_(std::move(limits)), sink_(std::move(sink)) {}

double RunFitter::tolerance() const {
  const double programmed = blocks_[first_].block.tolerance;
  return programmed > 0.0 ? programmed : settings_.chord_error;
}

void RunFitter::push(const gcode::Block& block, std::int64_t number) {
  if (blocks_.empty()) {
    points_.push_back(block.start);
  }
  blocks_.push_back({block, number});
  points_.push_back(block.end);
  while (waiting() >= static_cast<std::size_t>(settings_.max_segments) + kJointPoints + 2) {
    emit_piece(piece_length());
  }
}

void RunFitter::finish() {
  while (waiting() > 0) {
    const bool is_fresh = first_ == 0 && !begin_.clamped;
    if (is_fresh && waiting() < static_cast<std::size_t>(settings_.min_segments)) {
      emit_lines(waiting());
    } else {
      emit_piece(piece_length());
    }
  }
  advance_all();
}

/// Blocks in the next piece: up to max_segments of one feedrate, leaving no crumbs for the last
/// one.
std::size_t RunFitter::piece_length() const {
  const auto most = static_cast<std::size_t>(settings_.max_segments);
  const auto least = static_cast<std::size_t>(settings_.min_segments);
  std::size_t count = std::min(waiting(), most);
  if (const std::size_t rest = waiting() - count; rest > 0 && rest < least && count > 2 * least) {
    count -= least - rest;
  }
  const double feedrate = blocks_[first_].block.feedrate;
  for (std::size_t i = 1; i < count; ++i) {
    if (blocks_[first_ + i].block.feedrate != feedrate) {
      return i;
    }
  }
  return count;
}

/// What the curves on both sides of points_[joint] have in common there; nothing at the run's end.
geometry::EndCondition RunFitter::condition_at(std::size_t joint) {
  if (joint >= blocks_.size()) {
    return {};
  }
  if (settings_.curves == CurveKind::kBezier) {
    return geometry::circle_condition(points_[joint - 1], points_[joint], points_[joint + 1]);
  }
  const std::size_t from = joint - std::min(joint, kJointPoints);
  const std::size_t to = std::min(joint + kJointPoints, blocks_.size());
  return geometry::joint_condition(fitter_, std::span(points_).subspan(from, to - from + 1),
                                   joint - from);
}

geometry::FitResult RunFitter::fit(std::span<const Vec3> points, const geometry::EndCondition& end,
                                   geometry::Curve& curve) {
  return settings_.curves == CurveKind::kBezier ? bezier_fitter_.fit(points, begin_, end, curve)
                                                : fitter_.fit(points, begin_, end, curve);
}

/// Chord-length parameters of the last fit [mm].
const std::vector<double>& RunFitter::parameters() const {
  return settings_.curves == CurveKind::kBezier ? bezier_fitter_.parameters()
                                                : fitter_.parameters();
}

void RunFitter::emit_piece(std::size_t count) {
  const geometry::EndCondition end = condition_at(first_ + count);
  if (const auto worst = emit_curve(count, end)) {
    emit_broken(*worst);
  } else {
    begin_ = end;
    advance(count);
  }
}

/// The curve leaves the tolerance in block `worst`: that one stays a line, what is before it ends
/// there.
void RunFitter::emit_broken(std::size_t worst) {
  std::size_t before = worst;
  while (before > 0) {
    const bool is_enough =
        begin_.clamped || before >= static_cast<std::size_t>(settings_.min_segments);
    if (!is_enough) {
      before = 0;
    } else if (const auto again = emit_curve(before, {})) {
      before = std::min(*again, before - 1);
    } else {
      advance(before);
      break;
    }
  }
  emit_lines(worst - before + 1);
}

/// Fits a curve to the next `count` blocks.
/// @returns nothing if the curve is emitted, else the block in which it leaves the tolerance most;
///          0 where there is no curve
std::optional<std::size_t> RunFitter::emit_curve(std::size_t count,
                                                 const geometry::EndCondition& end) {
  const auto points = std::span<const Vec3>(points_).subspan(first_, count + 1);
  FittedCurve fitted;
  if (fit(points, end, fitted.curve) != geometry::FitResult::kFitted) {
    return 0;
  }
  if (const auto worst = block_off(fitted.curve, points)) {
    return worst;
  }
  measure(fitted);
  emit_segment(std::move(fitted), count);
  return std::nullopt;
}

/// The block from which the curve deviates most, if it deviates by more than the tolerance at all.
std::optional<std::size_t> RunFitter::block_off(const geometry::Curve& curve,
                                                std::span<const Vec3> points) const {
  const std::span<const double> at(parameters());
  if (!(geometry::deviation_bound(curve, points, at) > tolerance())) {
    return std::nullopt;
  }
  std::size_t worst = 0;
  double largest = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double deviation =
        geometry::deviation_bound(curve, points.subspan(i, 2), at.subspan(i, 2));
    if (deviation > largest) {
      largest = deviation;
      worst = i;
    }
  }
  return worst;
}

/// Segment of a curve through the next `count` blocks, with their marks.
void RunFitter::emit_segment(FittedCurve&& fitted, std::size_t count) {
  Segment segment = make_curve_segment(std::move(fitted));
  segment.feedrate = std::min(blocks_[first_].block.feedrate, limits_.feedrate);
  segment.corner_error =
      blocks_[first_].block.tolerance > 0.0 ? blocks_[first_].block.tolerance : model_.corner_error;
  const auto& curve = std::get<FittedCurve>(segment.geometry);
  const std::vector<double>& at = parameters();
  segment.marks.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const RunBlock& run = blocks_[first_ + i];
    const double s = i + 1 < count ? curve.arc_length.s_at(curve.curve, at[i + 1]) : segment.length;
    segment.marks.push_back(
        {s, (run.block.end - run.block.start).norm(), run.number, run.block.line});
  }
  sink_(std::move(segment));
}

void RunFitter::emit_lines(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const RunBlock& run = blocks_[first_ + i];
    sink_(make_segment(run.block, run.number, limits_, model_));
  }
  first_ += count;
  forget_settled(0);
  begin_ = {};
}

/// Marks blocks as settled; the last few stay for the next joint.
void RunFitter::advance(std::size_t count) {
  first_ += count;
  forget_settled(kJointPoints);
}

void RunFitter::forget_settled(std::size_t keep) {
  if (first_ <= keep) {
    return;
  }
  const auto drop = static_cast<std::ptrdiff_t>(first_ - keep);
  blocks_.erase(blocks_.begin(), blocks_.begin() + drop);
  points_.erase(points_.begin(), points_.begin() + drop);
  first_ = keep;
}

void RunFitter::advance_all() {
  blocks_.clear();
  points_.clear();
  first_ = 0;
  begin_ = {};
}

}  // namespace twin::path
