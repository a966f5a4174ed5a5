#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "core/vec.hpp"
#include "gcode/block.hpp"
#include "results/metrics/block_distance.hpp"

namespace twin::results {

/// Computes the contour error of a stream of positions against a stream of NC blocks, in bounded
/// memory.
///
/// The contour error is the distance of the position from the nearest point of the programmed path,
/// with lines and arcs exact. If a path passes close to itself, the nearest point of the whole path
/// may lie on another pass and hide an error. So only the part of the path where the machine can be
/// is searched:
///
///              c - w          c          c + w
///   -------------[------------x------------]----------->  arc length s
///                      nearest point to the command
///
/// c is the point of the command's NC block that is nearest to the command, but not more than kBack
/// behind the c of the command before. The half width is
///   w = window + 4 |position - command|,   at most kReach.
/// A tracking error of this size moves the nearest point along the path by as much, and by more
/// where the path bends, which the factor 4 covers.
///
/// The search goes outwards from c. If the end of a block is farther from the position than the
/// best point so far, by a length g, the search skips the next g of arc length, because the
/// distance cannot fall by more than the path advances.
class ContourTracker {
 public:
  /// Largest half width of the search [mm]. It covers a machine that lags by up to 5 mm. Twice as
  /// much covers twice the lag, and holds twice as much of the program in memory.
  static constexpr double kReach = 20.0;
  /// How far beyond the ends of its block the command may lie, since smoothing moves them [mm].
  static constexpr double kMargin = 0.5;
  /// How far c may step back from one command to the next, as it does in a sharp corner [mm].
  static constexpr double kBack = 0.1;

  /// @param view    whether distances are in space or as seen along Z
  /// @param window  half width of the search where the tracking error is zero [mm]
  explicit ContourTracker(View view, double window = 0.5) : view_(view), window_(window) {}

  /// Appends the next block of the program. Every block is appended in order, also one at rest.
  void add(const gcode::Block& block);

  /// Arc length that is known beyond the end of a block; negative if the block itself is not known
  /// yet [mm].
  /// @param block  number of the block, from 0
  double ahead(std::int64_t block) const noexcept;

  /// Whether enough blocks have come for follow() and nearest() with a command on this block:
  /// further blocks would not change the result.
  bool is_ready(std::int64_t block) const noexcept { return ahead(block) >= kReach + kMargin; }

  /// Moves on to the next command. Call it once for each set point.
  /// @param block    number of the command's NC block, from 0. The block must have been added, and
  ///                 numbers must not fall.
  /// @param command  set point [mm]
  void follow(std::int64_t block, const Vec3& command);

  /// Point of the programmed path that is nearest to a position, which the machine has at the
  /// instant of the last command.
  /// @param position  [mm]
  /// @returns the point; its distance is the contour error [mm]
  NearestPoint nearest(const Vec3& position) const;

  /// Number of blocks in memory.
  std::size_t stored() const noexcept { return pieces_.size(); }

 private:
  struct Piece {
    gcode::Block block;
    double s0;  // arc length of the path at the block's start [mm]
    double s1;  // arc length of the path at the block's end [mm]
  };
  /// The nearest point that a search has found so far.
  struct Found {
    NearestPoint place;
    double s = 0.0;         // arc length of the point [mm]
    bool is_known = false;  // whether a point was found
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
  std::int64_t first_ = 0;   // number of the block pieces_.front() in the program
  std::size_t current_ = 0;  // index of the piece on which c lies
  double place_ = 0.0;       // arc length of c [mm]
  Vec3 command_ = Vec3::Zero();
  bool has_command_ = false;
};

}  // namespace twin::results
