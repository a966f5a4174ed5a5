#pragma once

#include <cstdint>
#include <vector>

#include "geometry/smoothing/corner_bump.hpp"
#include "geometry/smoothing/sliding_vector.hpp"
#include "geometry/smoothing/span_checker.hpp"
#include "path/arc_pieces.hpp"
#include "path/segment_writer.hpp"

namespace twin::path {

/// Joins lines, arcs and smoothed runs with continuous tangent and curvature.
///
/// At a corner the path gets a bump (geometry::CornerBump) as wide as the tolerance allows, but no
/// wider than half of the element on either side, and than kWidest. Within the bump an arc is its
/// cubic pieces (append_arc_pieces). Beyond, lines and arcs are exact.
///
/// A corner that nearly turns back, |C'(0-) + C'(0+)| / 2 < kLeastPace, stays sharp.
///
/// Elements come in order, with their base path lengths; a run comes span by span. An element goes
/// to the writer as soon as the corner behind it has its shape; a long run goes on the way, except
/// for the spans that the corner at its end may change.
class Joiner : public geometry::RunSink {
 public:
  explicit Joiner(SegmentWriter& writer) : writer_(writer) {}

  /// Tolerance of the elements that follow [mm].
  void set_tolerance(double tolerance) { tolerance_ = tolerance; }

  void take_span(const geometry::SpanCubic& span, double deviation) override;
  void take_block(const Vec3& from, const Vec3& to, double begin, double end) override;
  void end_run() override;
  void take_arc(const Arc& arc, double begin);
  /// Everything so far comes out and ends where it is, sharp.
  void finish();

 private:
  struct Span {
    geometry::SpanCubic cubic;
    double deviation;
  };
  enum class ElementEnd : std::uint8_t { kFirst, kLast };
  enum class Kind : std::uint8_t { kNone, kLine, kArc, kRun };
  struct Element {
    Kind kind = Kind::kNone;
    double begin = 0.0;  // base path length
    double end = 0.0;    // of a run, of what is known
    double from = 0.0;   // what is before has been given away
    double tolerance = 0.0;
    Line line;
    Arc arc;
    geometry::SlidingVector<Span> spans;
  };

  void begin_element(Kind kind, double begin, double end);
  void join_to_last();
  void end_element();
  void release_spans();
  double bump_width(const geometry::CornerBump& bump) const;
  void emit_bump(const geometry::CornerBump& bump, double width);
  void emit_body(Element& element, double end);

  static PathPoint base_point(const Element& element, ElementEnd end);
  static double deviation(const Element& element, double begin, double end);
  void append_pieces(const Element& element, double begin, double end);

  SegmentWriter& writer_;
  double tolerance_ = 0.0;
  Element before_;
  Element under_way_;
  bool is_joined_ = false;  // the corner at the begin of under_way_ has its shape
  std::vector<geometry::SpanCubic> pieces_;
};

}  // namespace twin::path
