#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "core/vec.hpp"
#include "gcode/block.hpp"
#include "results/metrics/block_distance.hpp"

namespace twin::results {

/// Contour error of a stream of positions against a stream of NC blocks, in bounded memory.
///
/// The contour error is the distance to the nearest place of the programmed path, with lines and
/// arcs exact. Where a path passes close to itself, the nearest place of the whole path could
/// belong to another pass and hide an error. So only that part of the path is searched on which the
/// machine can be:
///
///              c - w          c          c + w
///   -------------[------------x------------]----------->  arc length s
///                             command's place
///
/// c is the place of the command: the nearest place within its NC block that is not behind the
/// place of the command before (by more than kBack). The half width is
///   w = window + 4 |position - command|,   at most kReach.
/// The tracking error moves the position along the path by its own size, and by more where the path
/// bends, which the factor 4 covers.
///
/// The search goes outwards from c. Where the end of a block is farther from the position than the
/// best place so far, by g, the search skips the next g of arc length: a path comes no nearer than
/// it advances.
class ContourTracker {
 public:
  /// Most arc length that is searched on either side [mm]. Twice as much finds the place of a
  /// machine that lags by more than 5 mm, and more of the program is held in memory.
  static constexpr double kReach = 20.0;
  /// How far the command may lie beyond the ends of its block [mm]: smoothing moves block ends.
  static constexpr double kMargin = 0.5;
  /// How far the place of the command may step back [mm], as it does inside a sharp corner.
  static constexpr double kBack = 0.1;

  /// @param window  arc length that is searched on either side where the tracking error is zero [mm]
  explicit ContourTracker(View view, double window = 0.5) : view_(view), window_(window) {}

  /// Appends the next block of the program. Every block is appended in order, also one at rest.
  void add(const gcode::Block& block);

  /// Arc length known beyond the end of a block; negative if the block itself is not known yet
  /// [mm].
  double ahead(std::int64_t block) const noexcept;

  /// Whether the blocks so far decide what follow() and nearest() return for a command on this
  /// block.
  bool is_ready(std::int64_t block) const noexcept { return ahead(block) >= kReach + kMargin; }

  /// Moves on to the next command.
  /// @param block    NC block of the command, from 0, no lower than before; it must have been added
  /// @param command  set point [mm]
  void follow(std::int64_t block, const Vec3& command);

  /// Place of the programmed path that belongs to a position at the instant of the last command.
  /// @param position [mm] @returns the place; its distance is the contour error [mm]
  NearestPoint nearest(const Vec3& position) const;

  /// Blocks held at present.
  std::size_t stored() const noexcept { return pieces_.size(); }

 private:
  struct Piece {
    gcode::Block block;
    double s0;  // arc length of the path at its start [mm]
    double s1;  // and at its end [mm]
  };
  /// The nearest place that a search has found so far.
  struct Found {
    NearestPoint place;
    double s = 0.0;         // its arc length [mm]
    bool is_known = false;  // there is one
  };

  double separation(const Vec3& a, const Vec3& b) const noexcept;
  std::size_t index_of(std::int64_t block) const noexcept;
  Found search(const Vec3& point, double lo, double hi, std::size_t start) const;
  enum class Direction : std::uint8_t { kForward, kBackward };
  double look_at(const Vec3& point, double lo, double hi, const Piece& piece, Direction direction,
                 Found& best) const;
  void drop_old();

  View view_;
  double window_;
  std::deque<Piece> pieces_;
  std::int64_t first_ = 0;   // number of pieces_.front() in the program
  std::size_t current_ = 0;  // piece the command's place is on
  double place_ = 0.0;       // arc length of the command's place [mm]
  Vec3 command_ = Vec3::Zero();
  bool has_command_ = false;
};

}  // namespace twin::results
