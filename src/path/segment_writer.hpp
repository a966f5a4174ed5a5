#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/nurbs/span_cubic.hpp"
#include "geometry/smoothing/sliding_vector.hpp"
#include "path/builder.hpp"
#include "path/segment.hpp"

namespace twin::path {

/// What a block asks of the segments it becomes, and where it ends on the base path.
struct BlockDemand {
  double end = 0.0;           ///< base path length at its end [mm]
  double length = 0.0;        ///< as programmed [mm]
  std::int64_t number = 0;    ///< counted from 0
  std::int64_t line = 0;      ///< NC line
  double feedrate = 0.0;      ///< [mm/s]
  double corner_error = 0.0;  ///< [mm]
  double deviation = 0.0;     ///< of the base path at its end from the block's own [mm]
  bool is_rapid = false;

  bool has_same_demands(const BlockDemand& other) const noexcept {
    return feedrate == other.feedrate && corner_error == other.corner_error &&
           is_rapid == other.is_rapid;
  }
};

/// Makes segments of a path that arrives as cubic pieces, lines and arcs. The base path length is
/// the parameter of all of them. A block is added before the first piece that it is part of.
///
/// Pieces that follow each other become curves of at most kMostSpans spans; a curve also ends where
/// the demands of the blocks change. A block that lies on several segments has a mark on each of
/// them. Where the tangent turns from one segment to the next, the path comes to rest.
class SegmentWriter {
 public:
  explicit SegmentWriter(Builder::Sink sink) : sink_(std::move(sink)) {}

  void add_block(const BlockDemand& block) { blocks_.push_back(block); }

  /// The next piece.
  /// @param deviation  bound of its distance from the programmed path, both ways [mm]
  void cubic(const geometry::SpanCubic& piece, double deviation);
  /// A straight piece from base path length `begin` to `end`.
  void line(const Line& line, double begin, double end);
  void arc(const Arc& arc, double begin, double end);
  /// A segment that is complete, with marks of its own.
  void whole(Segment&& segment);
  /// The path is not smooth here.
  void end_curve() { flush(); }
  /// Everything so far comes out.
  void finish();

 private:
  void flush();
  void advance_to(double s);
  void append(const geometry::SpanCubic& piece, double deviation);
  void exact(Segment&& segment, double begin, double end);
  void set_demands(Segment& segment) const;
  template <class PlaceOf>
  void mark_blocks(Segment& segment, double end, const PlaceOf& place_of);
  void emit(Segment&& segment);

  Builder::Sink sink_;
  geometry::SlidingVector<BlockDemand> blocks_;  // not yet over
  BlockDemand latest_;                           // the last one that was over
  std::size_t at_ = 0;                           // block of the latest piece
  std::size_t first_ = 0;                        // block whose demands the segment under way has
  std::vector<geometry::SpanCubic> pieces_;      // of the curve under way
  double deviation_ = 0.0;
  double tail_deviation_ = 0.0;  // of the blocks at the end of the last segment
  std::optional<Segment> last_;
};

}  // namespace twin::path
