#include "path/segment_writer.hpp"

#include <algorithm>
#include <utility>

#include "geometry/smoothing/piecewise.hpp"

namespace twin::path {
namespace {

/// Most spans of a curve. Longer curves are fewer segments, but a segment leaves for the planner as
/// a whole, so twice as many spans double what waits.
constexpr std::size_t kMostSpans = 32;
constexpr double kSame = 1e-4;      // block ends this near to a segment's end are at it [mm]
constexpr double kStraight = 1e-6;  // turn that is none [rad]

/// Largest turn between a NURBS of the program and its neighbour that is passed as a corner, whose
/// limits are those of JunctionLimits [rad]. CAM systems write curves that should be tangent with
/// few decimals, which gives some 1e-4 rad. Twice as much would pass kinks that somebody can see at
/// a feedrate hardly above rest.
constexpr double kGentleTurn = 0.02;

bool is_programmed_curve(const Segment& segment) {
  const auto* curve = std::get_if<FittedCurve>(&segment.geometry);
  return curve != nullptr && curve->is_programmed;
}

}  // namespace

/// A curve that ends before the block begins, and has other demands, ends here.
void SegmentWriter::add_block(const BlockDemand& block) {
  if (blocks_.is_empty() && !latest_.has_same_demands(block)) {
    flush();
  }
  blocks_.push_back(block);
}

/// Makes the block that goes on beyond s the current one; a curve ends where the demands change.
/// The end of a curve may end several blocks, which are gone then.
void SegmentWriter::advance_to(double s) {
  at_ = std::max(at_, blocks_.begin_index());
  while (at_ + 1 < blocks_.end_index() && blocks_[at_].end <= s) {
    if (!blocks_[at_].has_same_demands(blocks_[at_ + 1])) {
      flush();
    }
    at_ = std::max(at_ + 1, blocks_.begin_index());
  }
}

/// Whether the demands change from the current block to the one that goes on beyond s.
bool SegmentWriter::changes_demands(double s) const {
  bool changes = false;
  for (std::size_t i = at_; i + 1 < blocks_.end_index() && blocks_[i].end <= s; ++i) {
    changes = changes || !blocks_[i].has_same_demands(blocks_[i + 1]);
  }
  return changes;
}

void SegmentWriter::cubic(const geometry::SpanCubic& piece, double deviation) {
  geometry::SpanCubic rest = piece;
  const double least = geometry::shortest_part(piece);
  advance_to(rest.begin + least);
  while (at_ + 1 < blocks_.end_index() && blocks_[at_].end < rest.end - least) {
    const double end = blocks_[at_].end;
    if (changes_demands(end + least)) {
      append(geometry::part_of(rest, rest.begin, end), deviation);
      rest = geometry::part_of(rest, end, rest.end);
    }
    advance_to(end + least);
  }
  append(rest, deviation);
}

void SegmentWriter::make_room(std::size_t pieces) {
  if (pieces_.size() + pieces > kMostSpans) {
    flush();
  }
}

void SegmentWriter::append(const geometry::SpanCubic& piece, double deviation) {
  if (pieces_.empty()) {
    first_ = at_;
  }
  pieces_.push_back(piece);
  deviation_ = std::max(deviation_, deviation);
  if (pieces_.size() == kMostSpans) {
    flush();
  }
}

/// The curve of the pieces so far.
void SegmentWriter::flush() {
  if (pieces_.empty()) {
    return;
  }
  const double begin = pieces_.front().begin;
  const double end = pieces_.back().end;
  FittedCurve fitted;
  fitted.curve = geometry::curve_from_pieces(pieces_);
  measure(fitted, sampling_);
  Segment segment = make_curve_segment(std::move(fitted));
  segment.deviation = deviation_;
  const auto& curve = std::get<FittedCurve>(segment.geometry);
  mark_blocks(segment, end,
              [&](double s) { return curve.arc_length.s_at(curve.curve, s - begin); });
  pieces_.clear();
  deviation_ = 0.0;
  emit(std::move(segment));
}

void SegmentWriter::set_demands(Segment& segment) const {
  const BlockDemand& block =
      blocks_.is_empty() ? latest_ : blocks_[std::max(first_, blocks_.begin_index())];
  segment.feedrate = block.feedrate;
  segment.corner_error = block.corner_error;
  segment.is_rapid = block.is_rapid;
}

/// Marks of the blocks that end on the segment, and of the one that goes on.
template <class PlaceOf>
void SegmentWriter::mark_blocks(Segment& segment, double end, const PlaceOf& place_of) {
  set_demands(segment);
  double moved = tail_deviation_;
  tail_deviation_ = 0.0;
  while (!blocks_.is_empty()) {
    const BlockDemand& block = latest_ = blocks_.front();
    const bool is_inside = block.end < end - kSame;
    const bool goes_on = block.end > end + kSame;
    const double s = is_inside ? std::min(place_of(block.end), segment.length) : segment.length;
    segment.marks.push_back({s, block.length, block.number, block.line});
    moved = std::max(moved, block.deviation);
    tail_deviation_ = is_inside ? 0.0 : std::max(tail_deviation_, block.deviation);
    if (goes_on) {
      break;
    }
    blocks_.drop_before(blocks_.begin_index() + 1);
    if (!is_inside && (blocks_.is_empty() || blocks_.front().end > end + kSame)) {
      break;
    }
  }
  if (segment.marks.empty()) {  // what is left behind the end of the last block, all but
    segment.marks.push_back({segment.length, latest_.length, latest_.number, latest_.line});
  }
  const double ahead = blocks_.is_empty() ? 0.0 : blocks_.front().deviation;
  segment.deviation += std::max(moved, ahead);
}

void SegmentWriter::exact(Segment&& segment, double begin, double end) {
  advance_to(begin + kSame);
  flush();
  first_ = at_;
  const bool is_passage = std::holds_alternative<CornerMotion>(segment.geometry);
  const double scale = is_passage ? segment.length / (end - begin) : 1.0;
  mark_blocks(segment, end, [&](double s) { return (s - begin) * scale; });
  emit(std::move(segment));
}

void SegmentWriter::line(const Line& line, double begin, double end) {
  Segment segment;
  segment.length = end - begin;
  segment.begin = point_at(line, 0.0);
  segment.end = point_at(line, segment.length);
  segment.geometry = line;
  exact(std::move(segment), begin, end);
}

void SegmentWriter::arc(const Arc& arc, double begin, double end) {
  Segment segment;
  segment.length = arc.length;
  segment.begin = point_at(arc, 0.0);
  segment.end = point_at(arc, arc.length);
  segment.geometry = arc;
  exact(std::move(segment), begin, end);
}

void SegmentWriter::passage(const CornerMotion& passage, double begin, double end) {
  Segment segment;
  segment.length = passage.length();
  const auto point = [&](double s) -> PathPoint {
    const SpaceMotion at = motion_in(passage, s, passage.feedrate, 0.0);
    return {at.position, at.velocity.normalized(), Vec3::Zero()};
  };
  segment.begin = point(0.0);
  segment.end = point(segment.length);
  segment.deviation = passage.deviation;
  segment.geometry = passage;
  exact(std::move(segment), begin, end);
}

void SegmentWriter::curve(FittedCurve&& curve, double begin, double end) {
  exact(make_curve_segment(std::move(curve)), begin, end);
}

void SegmentWriter::whole(Segment&& segment) {
  flush();
  emit(std::move(segment));
}

/// One segment is kept back until it is known whether the path turns at its end.
void SegmentWriter::emit(Segment&& segment) {
  if (last_) {
    const bool is_free = is_programmed_curve(*last_) || is_programmed_curve(segment);
    const bool turns =
        (last_->end.tangent - segment.begin.tangent).norm() > (is_free ? kGentleTurn : kStraight);
    last_->stops_at_end = last_->stops_at_end || (turns && segment.length > 0.0);
    sink_(std::move(*last_));
  }
  last_ = std::move(segment);
  is_empty_ = false;
}

void SegmentWriter::finish() {
  flush();
  if (last_) {
    sink_(std::move(*last_));
    last_.reset();
  }
}

}  // namespace twin::path
