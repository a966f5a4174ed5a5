#pragma once

#include <cstdint>
#include <vector>

#include "core/error.hpp"
#include "gcode/block.hpp"
#include "gcode/interpreter/offset_side.hpp"

namespace twin::gcode {

/// Keeps the centre of a cutter beside the programmed contour, as G41 and G42 ask for.
///
/// Where a piece of the contour ends depends on the next one, so one piece is always held back.
///   - The first piece, straight or arc, leads from where the cutter is to the place beside its end.
///   - In a corner of less than kFlatCorner the next piece begins where this one ends.
///   - In a corner whose outside the cutter is on, it goes round the corner on an arc of its own
///     radius, or straight before a rapid.
///   - In a corner whose inside it is on, both pieces are cut short where the two curves beside them
///     meet. A piece of which nothing is left would gouge the contour and is refused.
///   - The last piece ends beside its end; the move behind G40 leads from there to its own end and
///     must be straight.
/// Moves across the plane and rests keep their place between the pieces. Source: LinuxCNC, "Tool
/// Compensation"; NIST, "The NIST RS274NGC Interpreter - Version 3", appendix on cutter radius
/// compensation.
class CutterCompensation {
 public:
  static constexpr double kFlatCorner = 0.05;        ///< [rad]
  static constexpr std::size_t kMostBetween = 1000;  ///< blocks between two pieces of the contour

  /// @param distance  radius of the cutter, above zero to the left of the contour [mm]
  void start(double distance, Plane plane);
  bool is_on() const noexcept { return is_on_; }

  /// Takes the next block of the contour, which starts where the one before it ended.
  ///
  /// @param feedrate  on an arc round a corner [mm/s]
  /// @returns the error, with column 0, of a block that cannot be followed
  Expected<void> add(const Block& block, double feedrate);

  /// Ends the compensation. @returns where the cutter is then; `place` if it has not moved [mm]
  Expected<Vec3> finish(const Vec3& place);

  /// Appends the blocks that are ready, which are then given out.
  void take_ready(std::vector<Block>& to);

 private:
  Expected<void> enter(const Block& block);
  Expected<void> turn_corner(const OffsetSide& next, const Block& block);
  Expected<void> release(const Vec2& end, const Block& reason);
  void go_round(const OffsetSide& next, const Block& block);
  Expected<void> bend_entry(const Block& block);

  bool is_on_ = false;
  double distance_ = 0.0;
  double feedrate_ = 0.0;
  PlaneAxes axes_{0, 1, 2};
  bool has_held_ = false;
  bool is_full_ = false;        // between_ has no more room
  Block held_;                  // its start is the cutter's, its end that of the contour
  OffsetSide side_;             // of held_
  double slack_ = 0.0;          // by which held_ may be longer than its side, or run back [mm]
  std::vector<Block> between_;  // blocks behind held_ that stay at its end in the plane
  std::vector<Block> ready_;
  Vec3 at_ = Vec3::Zero();  // end of the last block that is ready [mm]
};

}  // namespace twin::gcode
