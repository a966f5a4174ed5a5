#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/nurbs/span_cubic.hpp"
#include "geometry/smoothing/sliding_vector.hpp"
#include "path/builder.hpp"
#include "path/segment.hpp"

namespace twin::path {

/// What a block requires of the segments that it becomes, and where it ends on the base path, the
/// path of the blocks before smoothing.
struct BlockDemand {
  double end = 0.0;           ///< length of the base path up to the block's end [mm]
  double length = 0.0;        ///< programmed length of the block [mm]
  std::int64_t number = 0;    ///< number of the block, from 0
  std::int64_t line = 0;      ///< NC line
  double feedrate = 0.0;      ///< [mm/s]
  double corner_error = 0.0;  ///< [mm]
  double deviation = 0.0;     ///< distance of the base path from the programmed end point [mm]
  bool is_rapid = false;

  bool has_same_demands(const BlockDemand& other) const noexcept {
    return feedrate == other.feedrate && corner_error == other.corner_error &&
           is_rapid == other.is_rapid;
  }
};

/// Makes the segments of a path that arrives as cubic pieces, lines and arcs. The parameter of all
/// of them is the length of the base path. A block must be added before the first piece that is a
/// part of it.
///
/// Successive cubic pieces become one curve of at most kMostSpans spans. A curve also ends where
/// the requirements of the blocks change. A block that lies on several segments has a mark on each
/// of them. If the tangent turns from one segment to the next, the path comes to rest there. Where
/// one of them is a NURBS of the program, a turn of up to 0.02 rad is left to the feedrate.
///
/// A block counts as ended where a segment ends within 0.1 um of its end. The rest of such a block
/// may still come, in pieces that no block is left for: they have the demands and the mark of the
/// block that ended last.
class SegmentWriter {
 public:
  /// @param sampling  of the curvature of curves; sparse where only the largest curvature of a place
  ///                  counts, and not how it changes
  explicit SegmentWriter(Builder::Sink sink,
                         geometry::Sampling sampling = geometry::Sampling::kSparse)
      : sink_(std::move(sink)), sampling_(sampling) {}

  void add_block(const BlockDemand& block);

  /// Makes room for pieces that belong together: none of the next `pieces` ends a curve by being one too
  /// many. A corner that two curves share would be a bend of each, cut by its end.
  void make_room(std::size_t pieces);
  /// Appends a cubic piece.
  /// @param deviation  no point of the piece or of the program is farther from the other [mm]
  void cubic(const geometry::SpanCubic& piece, double deviation);
  /// Appends a line.
  /// @param begin, end  length of the base path at both ends of the line [mm]
  void line(const Line& line, double begin, double end);
  /// Appends an arc; begin and end as for line().
  void arc(const Arc& arc, double begin, double end);
  /// Appends the passage of a corner between two lines; begin and end as for line().
  void passage(const CornerMotion& passage, double begin, double end);
  /// Appends a NURBS of the program; begin and end as for line().
  void curve(FittedCurve&& curve, double begin, double end);
  /// Appends a segment that is complete and has its own marks.
  void whole(Segment&& segment);
  /// Ends the current curve, because the path is not smooth here.
  void end_curve() { flush(); }
  /// Gives all segments that are left to the sink.
  void finish();
  /// Whether no segment has come out of what was appended.
  bool is_empty() const noexcept { return is_empty_ && pieces_.empty(); }

 private:
  void flush();
  void advance_to(double s);
  bool changes_demands(double s) const;
  void append(const geometry::SpanCubic& piece, double deviation);
  void exact(Segment&& segment, double begin, double end);
  void set_demands(Segment& segment) const;
  template <class PlaceOf>
  void mark_blocks(Segment& segment, double end, const PlaceOf& place_of);
  void emit(Segment&& segment);

  Builder::Sink sink_;
  geometry::Sampling sampling_;
  geometry::SlidingVector<BlockDemand> blocks_;  // blocks that may lie on further pieces
  BlockDemand latest_;                           // last block that has ended
  std::size_t at_ = 0;     // block of the latest piece; one past the last where none is left for it
  std::size_t first_ = 0;  // block that sets the current segment's demands
  std::vector<geometry::SpanCubic> pieces_;  // of the current curve
  double deviation_ = 0.0;
  double tail_deviation_ = 0.0;  // of the blocks at the end of the last segment
  std::optional<Segment> last_;
  bool is_empty_ = true;
};

}  // namespace twin::path
