#include "path/joiner.hpp"

#include <algorithm>
#include <utility>

#include "geometry/smoothing/piecewise.hpp"

namespace twin::path {
namespace {

constexpr double kWidest = 4.0;         // half width of a bump [mm]
constexpr double kLeastPace = 0.02;     // |dC/ds| at a corner
constexpr double kNoJump = 1e-10;       // of C' [-] and C'' [1/mm]
constexpr double kArcDeviation = 1e-5;  // of an arc's pieces [mm]
constexpr double kShareUsed = 0.975;    // of the tolerance; set points tell a vertex so exactly
constexpr double kMergedLine = 1.0;     // a shorter line between two bumps is part of a curve [mm]
constexpr double kNothing = 1e-9;       // a length that is none [mm]
constexpr double kShortestBody = 1e-4;  // between two bumps, unless there is none at all [mm]
constexpr std::size_t kMostHeld = 64;   // spans of a run that wait for its end
constexpr std::size_t kFewestHeld = 12;

}  // namespace

void Joiner::take_block(const Vec3& from, const Vec3& to, double begin, double end) {
  begin_element(Kind::kLine, begin, end);
  under_way_.line = {from, (to - from) / (to - from).norm()};
  settle_begin();
  end_element();
}

void Joiner::take_arc(const Arc& arc, double begin) {
  begin_element(Kind::kArc, begin, begin + arc.length);
  under_way_.arc = arc;
  settle_begin();
  end_element();
}

void Joiner::take_span(const geometry::SpanCubic& span, double deviation) {
  if (under_way_.kind == Kind::kNone) {
    begin_element(Kind::kRun, span.begin, span.end);
  }
  under_way_.end = span.end;
  under_way_.spans.push_back({span, deviation});
  if (!has_begin_ && (under_way_.end - under_way_.begin >= 2.0 * kWidest ||
                      under_way_.spans.size() >= kMostHeld)) {
    settle_begin();
  }
  if (has_begin_) {
    give_away_run();
  }
}

void Joiner::end_run() {
  if (under_way_.kind == Kind::kNone) {
    return;
  }
  if (!has_begin_) {
    settle_begin();
  }
  end_element();
}

void Joiner::begin_element(Kind kind, double begin, double end) {
  under_way_.kind = kind;
  under_way_.begin = under_way_.from = begin;
  under_way_.end = end;
  under_way_.tolerance = tolerance_;
  under_way_.spans.restart(0);
  has_begin_ = false;
}

void Joiner::end_element() {
  std::swap(before_, under_way_);
  under_way_.kind = Kind::kNone;
}

void Joiner::finish() {
  if (before_.kind != Kind::kNone) {
    put_body(before_, before_.end);
    before_.kind = Kind::kNone;
  }
}

/// Spans of a run that no bump at its end can reach.
void Joiner::give_away_run() {
  Element& run = under_way_;
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
PathPoint Joiner::place(const Element& element, bool at_end) {
  if (element.kind == Kind::kLine) {
    return point_at(element.line, at_end ? element.end - element.begin : 0.0);
  }
  if (element.kind == Kind::kArc) {
    return point_at(element.arc, at_end ? element.arc.length : 0.0);
  }
  const geometry::SpanCubic& cubic =
      at_end ? element.spans.back().cubic : element.spans.front().cubic;
  const geometry::SpanCubic there =
      geometry::part_of(cubic, at_end ? cubic.end : cubic.begin, cubic.end);
  return {there.c0, there.c1, 2.0 * there.c2};
}

/// Bound of the base path's distance from the program over a stretch [mm].
double Joiner::deviation(const Element& element, double begin, double end) {
  double largest = element.kind == Kind::kArc ? kArcDeviation : 0.0;
  for (std::size_t i = element.spans.begin_index(); i < element.spans.end_index(); ++i) {
    const Span& span = element.spans[i];
    if (span.cubic.end > begin && span.cubic.begin < end) {
      largest = std::max(largest, span.deviation);
    }
  }
  return largest;
}

/// The corner between the last element and the one under way.
void Joiner::settle_begin() {
  has_begin_ = true;
  if (before_.kind == Kind::kNone) {
    return;
  }
  const PathPoint end = place(before_, true);
  const PathPoint begin = place(under_way_, false);
  geometry::CornerBump bump{begin.tangent - end.tangent, begin.curvature - end.curvature};
  const bool has_jump = bump.turn.norm() > kNoJump || bump.bend.norm() > kNoJump;
  const bool can_pass = 0.5 * (begin.tangent + end.tangent).norm() >= kLeastPace;
  const double width = has_jump && can_pass ? bump_width(bump) : 0.0;
  if (width < 2.0 * geometry::kShortestPiece) {
    put_body(before_, before_.end);
    if (has_jump) {
      writer_.end_curve();
    }
    return;
  }
  put_body(before_, before_.end - width);
  put_corner(bump, width);
}

/// Half width that the tolerance and both elements allow [mm].
double Joiner::bump_width(const geometry::CornerBump& bump) const {
  const double tolerance = kShareUsed * std::min(before_.tolerance, under_way_.tolerance);
  const double room = before_.end - before_.from;
  const double corner = before_.end;
  double width = std::min({kWidest, 0.5 * (before_.end - before_.begin), room,
                           0.5 * (under_way_.end - under_way_.begin), bump.width(tolerance)});
  const double base = std::max(deviation(before_, corner - width, corner),
                               deviation(under_way_, corner, corner + width));
  if (base >= tolerance) {
    return 0.0;
  }
  width = std::min(width, bump.width(tolerance - base));
  const double left = room - width;
  const double least = std::min(kShortestBody, 0.05 * (before_.end - before_.begin));
  return left > kNothing && left < least ? width - (least - left) : width;
}

void Joiner::put_corner(const geometry::CornerBump& bump, double width) {
  const double corner = before_.end;
  const double base = std::max(deviation(before_, corner - width, corner),
                               deviation(under_way_, corner, corner + width));
  pieces_.clear();
  append_pieces(before_, corner - width, corner);
  append_pieces(under_way_, corner, corner + width);
  geometry::add_bump(bump, corner, width, pieces_);
  for (const geometry::SpanCubic& piece : pieces_) {
    writer_.cubic(piece, base + bump.height(width));
  }
  under_way_.from = corner + width;
}

/// Pieces of the base path over a stretch of an element.
void Joiner::append_pieces(const Element& element, double begin, double end) {
  if (element.kind == Kind::kLine) {
    const Vec3 start = element.line.start + (begin - element.begin) * element.line.direction;
    pieces_.push_back({begin, end, start, element.line.direction, Vec3::Zero(), Vec3::Zero()});
    return;
  }
  if (element.kind == Kind::kArc) {
    append_arc_pieces(element.arc, begin - element.begin, end - element.begin, element.begin,
                      pieces_);
    return;
  }
  double from = begin;
  const std::size_t first = pieces_.size();
  for (std::size_t i = element.spans.begin_index(); i < element.spans.end_index(); ++i) {
    const geometry::SpanCubic& span = element.spans[i].cubic;
    const double to = std::min(span.end, end);
    if (to - from >= geometry::shortest_part(span) || (to == end && pieces_.size() == first)) {
      pieces_.push_back(geometry::part_of(span, from, to));
      from = to;
    } else if (to > from && pieces_.size() > first) {
      pieces_.back().end = from = to;
    }
    if (to == end) {
      return;
    }
  }
}

/// What is left of an element before `end`.
void Joiner::put_body(Element& element, double end) {
  const double length = end - element.from;
  if (length <= kNothing) {
    return;
  }
  if (element.kind == Kind::kArc) {
    const bool is_whole = element.from == element.begin && end == element.end;
    writer_.arc(is_whole ? element.arc
                         : part_of(element.arc, element.from - element.begin, end - element.begin),
                element.from, end);
  } else if (element.kind == Kind::kLine &&
             length >= std::min(kMergedLine, element.end - element.begin)) {
    writer_.line({element.line.start + (element.from - element.begin) * element.line.direction,
                  element.line.direction},
                 element.from, end);
  } else {
    pieces_.clear();
    append_pieces(element, element.from, end);
    for (const geometry::SpanCubic& piece : pieces_) {
      writer_.cubic(piece, deviation(element, piece.begin, piece.end));
    }
  }
  element.from = end;
}

}  // namespace twin::path
