#pragma once

#include <cstdint>
#include <deque>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "gcode/block.hpp"
#include "runtime/shared_blocks.hpp"

namespace twin::studies::linuxcnc {

/// Finds the block of a program on which a set point is that does not tell it, as those of another
/// controller. Set points come in the order of the program.
///
/// Of all points of the path not far ahead, the place of a set point p is the one with the least
///   d + 0.1 |s - (s_0 + w)|
/// where d is its distance from p, s its arc length, s_0 the last place and w the way of the set
/// point since then. The second term tells passes apart that lie on each other, as where a path goes
/// back the way it came.
class PlaceFinder {
 public:
  /// @param blocks  of the program, from its beginning
  explicit PlaceFinder(runtime::BlockSource blocks) : blocks_(std::move(blocks)) {}

  /// @returns number of the block, from 0, which never falls; or the program's error
  Expected<std::int64_t> find(const Vec3& point);
  /// Largest distance of a set point from its place so far [mm].
  double largest_distance() const noexcept { return largest_distance_; }
  /// Arc length of the last place [mm].
  double place() const noexcept { return place_; }

 private:
  struct Piece {
    gcode::Block block;
    double begin;  // arc length [mm]
    double length;
  };
  Expected<void> read_to(double arc_length);

  runtime::BlockSource blocks_;
  std::deque<Piece> pieces_;
  std::int64_t first_ = 0;  // number of pieces_.front()
  double known_ = 0.0;      // arc length of the end of pieces_.back() [mm]
  double place_ = 0.0;      // s_0 [mm]
  Vec3 last_ = Vec3::Zero();
  double largest_distance_ = 0.0;
  bool has_ended_ = false;
  bool has_begun_ = false;
};

}  // namespace twin::studies::linuxcnc
