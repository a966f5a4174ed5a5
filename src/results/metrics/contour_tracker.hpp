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
/// arcs exact. Nearest of the whole path would let a path that passes close to itself hide an
/// error, so only the part is looked at that the machine can be on:
///
///              c - w          c          c + w
///   -------------[------------x------------]----------->  arc length s
///                             command's place
///
/// c is the place of the command: nearest to it within its NC block, not behind its place of the
/// sample before (but for kBack). The half-width w = window + 4 |position - command|, at most
/// kReach: the tracking error displaces the position by its own size along the path, more where the
/// path bends, less in no case.
///
/// Walking outwards from c, a block end that is farther from the position than the best place by g
/// lets the walk skip the next g of arc length, for a path cannot come nearer faster than it
/// advances.
class ContourTracker {
 public:
  static constexpr double kReach = 20.0;  ///< most arc length looked at either side [mm]
  static constexpr double kMargin =
      0.5;  ///< the command may be past its block's ends by this much [mm]
  static constexpr double kBack = 0.1;  ///< the command's place may step back by this much [mm]

  /// @param window  arc length looked at either side of a position that is on its command [mm]
  explicit ContourTracker(View view, double window = 0.5) : view_(view), window_(window) {}

  /// Appends the next block of the program; all of them, in order, those at rest included.
  void add(const gcode::Block& block);

  /// Arc length known beyond the end of a block; negative if the block itself is not known yet
  /// [mm].
  double ahead(std::int64_t block) const noexcept;

  /// True when no further block can change what follow() and nearest() say of this command block.
  bool is_ready(std::int64_t block) const noexcept { return ahead(block) >= kReach + kMargin; }

  /// Moves on to the next command.
  /// @param block    NC block the command is on, from 0, not lower than before; it must have been
  /// added
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
  /// Place in arc length [mm] with the distance found there.
  struct Found {
    NearestPoint place;
    double s = 0.0;
    bool is_known = false;
  };

  double separation(const Vec3& a, const Vec3& b) const noexcept;
  std::size_t index_of(std::int64_t block) const noexcept;
  Found search(const Vec3& point, double lo, double hi, std::size_t start) const;
  double look_at(const Vec3& point, double lo, double hi, const Piece& piece, bool forward,
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
