#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "geometry/smoothing/corner_bump.hpp"
#include "geometry/smoothing/sliding_vector.hpp"
#include "geometry/smoothing/span_checker.hpp"
#include "path/arc_pieces.hpp"
#include "path/corner/corner_fit.hpp"
#include "path/corner/corner_table.hpp"
#include "path/corner_judge.hpp"
#include "path/segment_writer.hpp"

namespace twin::path {

/// Joins lines, arcs, smoothed runs and NURBS of the program with continuous tangent and curvature.
///
/// A corner is rounded by adding a bump to the path (geometry::CornerBump). The bump is as wide as
/// the tolerance allows, but not wider than kWidest or than half of the element on either side.
/// Within the bump an arc or a NURBS is replaced by cubic pieces (append_arc_pieces,
/// append_curve_pieces). Outside, lines, arcs and NURBS are exact. A joint of a NURBS that is smooth
/// but for rounding, and for decimals that the feedrate does not feel, is left as it is.
///
/// With CornerKind::kPassage and JerkOf::kVector a corner between two lines becomes a passage, a
/// motion in time (corner/corner_fit.hpp), where that loses less time.
///
/// Else a corner at which the path nearly turns back, |C'(0-) + C'(0+)| / 2 < kLeastPace, stays sharp. So
/// does one where the jerk of single axes lets a stop at the corner lose less time than the way
/// through the bump (path/passage.hpp), or where the judge of corners says so.
///
/// Elements (lines, arcs, runs, pieces of a NURBS) come in order, with the length of the base path at their ends; a
/// run comes span by span. An element is given to the writer as soon as the corner at its end is
/// rounded. A long run is given earlier, apart from the spans that the corner at its end may
/// change.
class Joiner : public geometry::RunSink {
 public:
  /// @param judge  of corners; null: every corner is rounded that can be
  Joiner(SegmentWriter& writer, const Limits& limits, CornerKind corners, CornerJudge* judge)
      : writer_(writer), limits_(limits), corners_(corners), judge_(judge) {}
  Joiner(const Joiner&) = delete;
  Joiner& operator=(const Joiner&) = delete;

  /// Sets what is asked for on the elements that follow.
  /// @param tolerance  [mm]
  /// @param feedrate   [mm/s]
  void set_demands(double tolerance, double feedrate) {
    tolerance_ = tolerance;
    feedrate_ = feedrate;
  }

  void take_span(const geometry::SpanCubic& span, double deviation) override;
  void take_block(const Vec3& from, const Vec3& to, double begin, double end) override;
  void end_run() override;
  void take_arc(const Arc& arc, double begin);
  void take_curve(FittedCurve&& curve, double begin);
  /// Gives everything that is left to the writer. The path ends there, without a rounded corner.
  void finish();

 private:
  static constexpr double kNothing = 1e-9;  ///< a length that is none [mm]

  struct Span {
    geometry::SpanCubic cubic;
    double deviation;
  };
  enum class ElementEnd : std::uint8_t { kFirst, kLast };
  enum class Kind : std::uint8_t { kNone, kLine, kArc, kRun, kCurve };
  struct Element {
    Kind kind = Kind::kNone;
    double begin = 0.0;  // length of the base path at its begin [mm]
    double end = 0.0;    // the same at its end; for a run, at the end of the known part [mm]
    double from = 0.0;   // the writer has got the part before this length [mm]
    double tolerance = 0.0;
    double feedrate = 0.0;
    double passage = 0.0;  // feedrate of the passage at its begin; 0: there is none [mm/s]
    Line line;
    Arc arc;
    FittedCurve curve;
    geometry::SlidingVector<Span> spans;
  };

  /// Times that a corner loses [s], beside a run of the nearer halves of both elements at the feedrates
  /// that are reached there.
  struct Losses {
    double in_bump = 0.0;
    double by_stop = 0.0;
    double run = 0.0;   ///< time of that run [s]
    double room = 0.0;  ///< its length [mm]
  };

  void begin_element(Kind kind, double begin, double end);
  void join_to_last();
  void end_element();
  void release_spans();
  bool join_by_passage(double bump_width, const std::function<double(double)>& other);
  double bump_width(const geometry::CornerBump& bump) const;
  Losses losses_at(const geometry::CornerBump& bump, double width, const PathPoint& end,
                   const PathPoint& begin) const;
  bool is_judged_sharp(double width, const PathPoint& end, const PathPoint& begin);
  void make_bump(const geometry::CornerBump& bump, double width);
  void emit_bump(const geometry::CornerBump& bump, double width);
  void emit_body(Element& element, double end);
  void emit_line(Element& element, double end);

  static PathPoint base_point(const Element& element, ElementEnd end);
  static double deviation(const Element& element, double begin, double end);
  static void append_pieces(const Element& element, double begin, double end,
                            std::vector<geometry::SpanCubic>& pieces);

  SegmentWriter& writer_;
  Limits limits_;
  CornerKind corners_;
  CornerJudge* judge_;
  CornerTable passages_;
  double tolerance_ = 0.0;
  double feedrate_ = 0.0;
  std::array<Element, 2> elements_;
  Element* before_ = &elements_[0];
  Element* under_way_ = &elements_[1];
  bool is_joined_ = false;                   // the corner at the begin of under_way_ is rounded
  std::vector<geometry::SpanCubic> bump_;    // the path around the corner at hand
  std::vector<geometry::SpanCubic> pieces_;  // of the body that is being sent
};

}  // namespace twin::path
