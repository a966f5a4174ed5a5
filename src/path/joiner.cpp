#include "path/joiner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/smoothing/piecewise.hpp"
#include "path/passage.hpp"

namespace twin::path {
namespace {

/// Largest half width of a bump [mm]. A wider bump has less curvature and a higher feedrate. Twice
/// as wide, lines and runs wait for twice the length of path before they go to the writer.
constexpr double kWidest = 4.0;

/// A corner stays sharp where the mean of both tangents is shorter than this [-]. It is the pace
/// |dC/ds| in the middle of the bump, which is near zero where the path turns back. A larger value
/// leaves more corners sharp, a smaller one makes bumps whose curvature allows next to no feedrate.
constexpr double kLeastPace = 0.02;

constexpr double kNoJump = 1e-10;  // of C' [-] and C'' [1/mm]
/// The same at a NURBS of the program [-], [1/mm]. A period at 200 mm/s sees 0.2 um/s and 4 mm/s^2 of
/// them. Smaller ones would replace exact curves by pieces for nothing.
constexpr double kNoTurnOfCurve = 1e-6;
constexpr double kNoBendOfCurve = 1e-4;
constexpr double kArcDeviation = 1e-5;  // of the pieces of an arc or a NURBS [mm]

/// Share of the tolerance that bump and base path use. The rest is for set points that pass a
/// vertex between two periods: they tell its place no more exactly. A larger share makes corners
/// faster by its square root, and the measured deviation may exceed the tolerance.
constexpr double kShareUsed = 0.975;

/// Share of an axis's jerk for the way through a bump, on an axis square to the path, and how much
/// less of it on an axis along the path: what feedrate/limits/axis_limits.cpp has for bends. They
/// decide which corners stay sharp, no limit.
constexpr double kBumpShare = 0.8;
constexpr double kBumpShareAlong = 0.34;
constexpr double kLeftShare = 0.05;  // the same of what is left there to the motion along the path
constexpr double kLeftShareAlong = 0.4;

constexpr double kShortestBody = 1e-4;  // between two bumps, unless there is none at all [mm]

/// Spans of a run that wait for its end. The most bound the memory; the fewest let a bump end
/// within a span that it changes, whatever the length of the spans.
constexpr std::size_t kMostHeld = 64;
constexpr std::size_t kFewestHeld = 12;

}  // namespace

void Joiner::take_block(const Vec3& from, const Vec3& to, double begin, double end) {
  begin_element(Kind::kLine, begin, end);
  under_way_->line = {from, (to - from) / (to - from).norm()};
  join_to_last();
  end_element();
}

void Joiner::take_arc(const Arc& arc, double begin) {
  begin_element(Kind::kArc, begin, begin + arc.length);
  under_way_->arc = arc;
  join_to_last();
  end_element();
}

void Joiner::take_curve(FittedCurve&& curve, double begin) {
  begin_element(Kind::kCurve, begin, begin + curve.arc_length.length());
  under_way_->curve = std::move(curve);
  join_to_last();
  end_element();
}

void Joiner::take_span(const geometry::SpanCubic& span, double deviation) {
  if (under_way_->kind == Kind::kNone) {
    begin_element(Kind::kRun, span.begin, span.end);
  }
  under_way_->end = span.end;
  under_way_->spans.push_back({span, deviation});
  if (!is_joined_ && (under_way_->end - under_way_->begin >= 2.0 * kWidest ||
                      under_way_->spans.size() >= kMostHeld)) {
    join_to_last();
  }
  if (is_joined_) {
    release_spans();
  }
}

void Joiner::end_run() {
  if (under_way_->kind == Kind::kNone) {
    return;
  }
  if (!is_joined_) {
    join_to_last();
  }
  end_element();
}

void Joiner::begin_element(Kind kind, double begin, double end) {
  under_way_->kind = kind;
  under_way_->begin = under_way_->from = begin;
  under_way_->end = end;
  under_way_->tolerance = tolerance_;
  under_way_->feedrate = feedrate_;
  under_way_->passage = 0.0;
  under_way_->spans.restart(0);
  is_joined_ = false;
}

void Joiner::end_element() {
  std::swap(before_, under_way_);
  under_way_->kind = Kind::kNone;
}

void Joiner::finish() {
  if (before_->kind != Kind::kNone) {
    emit_body(*before_, before_->end);
    before_->kind = Kind::kNone;
  }
}

/// Sends the spans of a run to the writer that no bump at its end can reach.
void Joiner::release_spans() {
  Element& run = *under_way_;
  while (run.spans.size() > kFewestHeld &&
         (run.end - run.spans.front().cubic.end >= kWidest || run.spans.size() > kMostHeld)) {
    const Span& span = run.spans.front();
    if (span.cubic.end - run.from >= geometry::shortest_part(span.cubic)) {
      writer_.cubic(geometry::part_of(span.cubic, run.from, span.cubic.end), span.deviation);
      run.from = span.cubic.end;
    }
    run.spans.drop_before(run.spans.begin_index() + 1);
  }
}

/// Base path at one of an element's ends, by its arc length or the run's parameter.
PathPoint Joiner::base_point(const Element& element, ElementEnd end) {
  const bool is_last = end == ElementEnd::kLast;
  if (element.kind == Kind::kLine) {
    return point_at(element.line, is_last ? element.end - element.begin : 0.0);
  }
  if (element.kind == Kind::kArc) {
    return point_at(element.arc, is_last ? element.arc.length : 0.0);
  }
  if (element.kind == Kind::kCurve) {
    const geometry::Curve& curve = element.curve.curve;
    return point_from(curve.derivatives(is_last ? curve.u_max() : curve.u_min()));
  }
  const geometry::SpanCubic& cubic =
      is_last ? element.spans.back().cubic : element.spans.front().cubic;
  const geometry::SpanCubic there =
      geometry::part_of(cubic, is_last ? cubic.end : cubic.begin, cubic.end);
  return {there.c0, there.c1, 2.0 * there.c2};
}

/// Bound of the base path's distance from the program over a stretch [mm].
double Joiner::deviation(const Element& element, double begin, double end) {
  const bool is_replaced = element.kind == Kind::kArc || element.kind == Kind::kCurve;
  double largest = is_replaced ? kArcDeviation : 0.0;
  for (std::size_t i = element.spans.begin_index(); i < element.spans.end_index(); ++i) {
    const Span& span = element.spans[i];
    if (span.cubic.end > begin && span.cubic.begin < end) {
      largest = std::max(largest, span.deviation);
    }
  }
  return largest;
}

/// Shapes the corner between the last element and the one under way: a bump, or sharp.
void Joiner::join_to_last() {
  is_joined_ = true;
  if (before_->kind == Kind::kNone) {
    return;
  }
  const PathPoint end = base_point(*before_, ElementEnd::kLast);
  const PathPoint begin = base_point(*under_way_, ElementEnd::kFirst);
  geometry::CornerBump bump{begin.tangent - end.tangent, begin.curvature - end.curvature};
  const bool is_curve = before_->kind == Kind::kCurve || under_way_->kind == Kind::kCurve;
  const bool has_jump = bump.turn.norm() > (is_curve ? kNoTurnOfCurve : kNoJump) ||
                        bump.bend.norm() > (is_curve ? kNoBendOfCurve : kNoJump);
  const bool can_pass = 0.5 * (begin.tangent + end.tangent).norm() >= kLeastPace;
  const double width = has_jump && can_pass ? bump_width(bump) : 0.0;
  const bool has_room = width >= 2.0 * geometry::kShortestPiece;
  const auto lost_without_passage = [&](double feedrate) {
    const Losses lost = losses_at(bump, width, end, begin);
    return (has_room ? std::min(lost.in_bump, lost.by_stop) : lost.by_stop) + lost.run -
           lost.room / feedrate;
  };
  if (bump.turn.norm() > kNoJump && join_by_passage(width, lost_without_passage)) {
    return;
  }
  const auto is_sharp = [&] {
    const Losses lost = losses_at(bump, width, end, begin);
    if (!has_room || lost.by_stop < lost.in_bump) {
      return true;
    }
    make_bump(bump, width);
    return is_judged_sharp(width, end, begin);
  };
  if (is_sharp()) {
    emit_body(*before_, before_->end);
    if (has_jump) {
      writer_.end_curve();
    }
    return;
  }
  emit_body(*before_, before_->end - width);
  emit_bump(bump, width);
}

/// Passes the corner between two lines by a motion in time.
/// @param bump_width  half width of the bump that could be there [mm]
/// @param other       time that the corner loses without a passage, beside a run at a feedrate
/// @returns false, with nothing done, where there is no better one than the bump
bool Joiner::join_by_passage(double bump_width, const std::function<double(double)>& other) {
  if (corners_ != CornerKind::kPassage ||
      (limits_.jerk_of == JerkOf::kPath && limits_.axis_jerk.isZero(0.0)) ||
      before_->kind != Kind::kLine || under_way_->kind != Kind::kLine) {
    return false;
  }
  const double tolerance = kShareUsed * std::min(before_->tolerance, under_way_->tolerance);
  const double corner = before_->end;
  const double after = under_way_->end - under_way_->begin;
  const auto passage =
      fit_passage(under_way_->line.start,
                  {before_->line.direction, corner - before_->begin, corner - before_->from,
                   before_->feedrate, before_->passage},
                  {under_way_->line.direction, after, (1.0 - kMostOfLegBesidePassage) * after,
                   under_way_->feedrate, 0.0},
                  tolerance, bump_width, limits_, passages_, other);
  if (!passage) {
    return false;
  }
  emit_line(*before_, corner - passage->way);
  writer_.passage(*passage, corner - passage->way, corner + passage->way);
  under_way_->from = corner + passage->way;
  under_way_->passage = passage->feedrate;
  return true;
}

/// Half width that the tolerance and both elements allow [mm].
double Joiner::bump_width(const geometry::CornerBump& bump) const {
  const double tolerance = kShareUsed * std::min(before_->tolerance, under_way_->tolerance);
  const double room = before_->end - before_->from;
  const double corner = before_->end;
  const double share = before_->passage > 0.0 ? kMostOfLegBesidePassage : 0.5;
  double width = std::min({kWidest, share * (before_->end - before_->begin), room,
                           0.5 * (under_way_->end - under_way_->begin), bump.width(tolerance)});
  const double base = std::max(deviation(*before_, corner - width, corner),
                               deviation(*under_way_, corner, corner + width));
  if (base >= tolerance) {
    return 0.0;
  }
  width = std::min(width, bump.width(tolerance - base));
  const double left = room - width;
  const double least = std::min(kShortestBody, 0.05 * (before_->end - before_->begin));
  return left > kNothing && left < least ? width - (least - left) : width;
}

/// Times that the corner loses in a bump, with what the jerk of axes allows in it, and with a stop at
/// the corner itself. A bump that no such jerk limits counts as one that loses nothing.
Joiner::Losses Joiner::losses_at(const geometry::CornerBump& bump, double width,
                                 const PathPoint& end, const PathPoint& begin) const {
  const Vec3 along = 0.5 * (end.tangent + begin.tangent).cwiseAbs();
  double v = std::numeric_limits<double>::infinity();
  double left = v;
  for (int i = 0; i < 3; ++i) {
    const double turn = std::abs(bump.turn[i]);
    if (limits_.axis_jerk[i] > 0.0 && along[i] > kNoJump) {
      left = std::min(left, (kLeftShare / along[i] + kLeftShareAlong) * limits_.axis_jerk[i]);
    }
    if (limits_.axis_jerk[i] > 0.0 && turn > kNoJump) {
      const double share = kBumpShare - kBumpShareAlong * along[i];
      v = std::min(v, std::cbrt(share * limits_.axis_jerk[i] * width * width / turn));
    }
  }
  if (limits_.jerk_of == JerkOf::kVector && bump.turn.norm() > kNoJump) {
    const double jerk = (kBumpShare - kBumpShareAlong) * limits_.jerk;
    v = std::min(v, std::cbrt(jerk * width * width / bump.turn.norm()));
    left = std::min(left, (kLeftShare + kLeftShareAlong) * limits_.jerk);
  }
  Losses lost;
  if (!std::isfinite(v)) {
    return lost;
  }
  const auto add_side = [&](const Element& element, const Vec3& tangent) {
    double jerk = limits_.jerk;
    for (int i = 0; i < 3; ++i) {
      if (limits_.axis_jerk[i] > 0.0 && std::abs(tangent[i]) > kNoJump) {
        jerk = std::min(jerk, limits_.axis_jerk[i] / std::abs(tangent[i]));
      }
    }
    const double room = 0.5 * (element.end - element.begin);
    const double feedrate = feedrate_within(room, element.feedrate, jerk);
    lost.in_bump += best_passage({width, v, std::min(left, jerk)}, feedrate, jerk).loss;
    lost.by_stop += stop_loss(feedrate, jerk);
    lost.run += room / feedrate;
    lost.room += room;
  };
  add_side(*before_, end.tangent);
  add_side(*under_way_, begin.tangent);
  return lost;
}

/// Whether the judge of corners would rather stop than go through the bump that was made.
bool Joiner::is_judged_sharp(double width, const PathPoint& end, const PathPoint& begin) {
  if (judge_ == nullptr) {
    return false;
  }
  return judge_->is_stop_quicker(
      {bump_,
       before_->end,
       width,
       {end, before_->end - before_->begin, before_->feedrate},
       {begin, under_way_->end - under_way_->begin, under_way_->feedrate}});
}

}  // namespace twin::path
