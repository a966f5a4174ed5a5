#pragma once

#include <cstdint>
#include <deque>

#include "path/segment.hpp"

namespace twin::runtime {

/// The part of the path that may have to be planned again: copies of its segments, from a little
/// behind the motion to the last one built.
class KeptPath {
 public:
  /// @param behind  length kept behind the motion, for corners that limit each other [mm]
  explicit KeptPath(double behind) : behind_(behind) {}

  void add(const path::Segment& segment);
  /// Forgets the segments that lie far enough behind the one that the motion has come to.
  void drop_before(std::int64_t segment);

  /// Index of the segment after the last one.
  std::int64_t end() const noexcept { return first_ + static_cast<std::int64_t>(pieces_.size()); }
  const path::Segment& operator[](std::int64_t index) const { return piece(index).segment; }
  /// Distance from the path's start to the start of a segment [mm].
  double begin_of(std::int64_t index) const { return piece(index).begin; }
  double end_of(std::int64_t index) const {
    return piece(index).begin + piece(index).segment.length;
  }
  /// The segment with which a plan begins that starts in the segment of an index: the corners from
  /// there on may limit each other. It does not depend on how much is still kept.
  std::int64_t lead_in(std::int64_t index) const;

 private:
  struct Piece {
    path::Segment segment;
    double begin;
  };
  const Piece& piece(std::int64_t index) const {
    return pieces_[static_cast<std::size_t>(index - first_)];
  }

  double behind_;
  std::deque<Piece> pieces_;
  std::int64_t first_ = 0;
  double length_ = 0.0;  // of the path so far [mm]
};

}  // namespace twin::runtime
