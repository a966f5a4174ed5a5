// What the joiner sends to the writer: bumps, and what is left of lines, arcs and curves between them.
#include <algorithm>
#include <utility>

#include "geometry/smoothing/piecewise.hpp"
#include "path/joiner.hpp"

namespace twin::path {
namespace {

/// A line between two bumps becomes part of the curve if it is shorter than this [mm]. A larger
/// value makes fewer segments, a smaller one keeps more lines exact.
constexpr double kMergedLine = 1.0;

}  // namespace

/// Makes the pieces of the path around the corner, bump_.
void Joiner::make_bump(const geometry::CornerBump& bump, double width) {
  const double corner = before_->end;
  bump_.clear();
  append_pieces(*before_, corner - width, corner, bump_);
  append_pieces(*under_way_, corner, corner + width, bump_);
  geometry::add_bump(bump, corner, width, bump_);
}

/// Sends the bump that was made to the writer.
void Joiner::emit_bump(const geometry::CornerBump& bump, double width) {
  const double corner = before_->end;
  const double base = std::max(deviation(*before_, corner - width, corner),
                               deviation(*under_way_, corner, corner + width));
  writer_.make_room(bump_.size());
  for (const geometry::SpanCubic& piece : bump_) {
    writer_.cubic(piece, base + bump.height(width));
  }
  under_way_->from = corner + width;
}

/// Pieces of the base path over a stretch of an element.
void Joiner::append_pieces(const Element& element, double begin, double end,
                           std::vector<geometry::SpanCubic>& pieces) {
  if (element.kind == Kind::kLine) {
    const Vec3 start = element.line.start + (begin - element.begin) * element.line.direction;
    pieces.push_back({begin, end, start, element.line.direction, Vec3::Zero(), Vec3::Zero()});
    return;
  }
  if (element.kind == Kind::kArc) {
    append_arc_pieces(element.arc, begin - element.begin, end - element.begin, element.begin,
                      pieces);
    return;
  }
  if (element.kind == Kind::kCurve) {
    append_curve_pieces(element.curve, begin - element.begin, end - element.begin, element.begin,
                        pieces);
    return;
  }
  double from = begin;
  const std::size_t first = pieces.size();
  for (std::size_t i = element.spans.begin_index(); i < element.spans.end_index(); ++i) {
    const geometry::SpanCubic& span = element.spans[i].cubic;
    const double to = std::min(span.end, end);
    if (to - from >= geometry::shortest_part(span) || (to == end && pieces.size() == first)) {
      pieces.push_back(geometry::part_of(span, from, to));
      from = to;
    } else if (to > from && pieces.size() > first) {
      pieces.back().end = from = to;
    }
    if (to == end) {
      return;
    }
  }
}

/// Sends what is left of a line before `end` to the writer, as a line.
void Joiner::emit_line(Element& element, double end) {
  writer_.line({element.line.start + (element.from - element.begin) * element.line.direction,
                element.line.direction},
               element.from, end);
  element.from = end;
}

/// Sends what is left of an element before `end` to the writer.
void Joiner::emit_body(Element& element, double end) {
  const double length = end - element.from;
  if (length <= kNothing) {
    return;
  }
  if (element.kind == Kind::kArc) {
    const bool is_whole = element.from == element.begin && end == element.end;
    writer_.arc(is_whole ? element.arc
                         : part_of(element.arc, element.from - element.begin, end - element.begin),
                element.from, end);
  } else if (element.kind == Kind::kCurve) {
    const bool is_whole = element.from == element.begin && end == element.end;
    writer_.curve(is_whole
                      ? std::move(element.curve)
                      : part_of(element.curve, element.from - element.begin, end - element.begin),
                  element.from, end);
  } else if (element.kind == Kind::kLine &&
             (element.passage > 0.0 ||
              length >= std::min(kMergedLine, element.end - element.begin))) {
    emit_line(element, end);
  } else {
    pieces_.clear();
    append_pieces(element, element.from, end, pieces_);
    for (const geometry::SpanCubic& piece : pieces_) {
      writer_.cubic(piece, deviation(element, piece.begin, piece.end));
    }
  }
  element.from = end;
}

}  // namespace twin::path
