#pragma once

#include <span>
#include <vector>

#include "feedrate/limits/limit_zone.hpp"
#include "feedrate/paper/hump.hpp"

namespace twin::feedrate {

/// Jerk-limited feedrate under limits that depend on the place: a chain of humps between knots.
///
///   limit  ------------.          .-------.     .------------
///                      |   ____   |       |     |
///          ___         '--/----\--'       '-----'   ___
///   feed  /   \          /      \        _______   /   \.
///        /     \________/        \______/       \_/     \.
///       start   knot  knot       knot          knot      end
///
/// Where the limit is lowest, the feedrate should just touch it with no acceleration: that is a
/// knot. So:
///   1. Take one hump from start to end under the largest limit there.
///   2. Find, of all zones in which it is too fast, the one with the lowest limit.
///   3. Put a knot where the hump enters it too fast and where it leaves it too fast (or, if the
///      hump is too fast only inside, or a knot there cannot be reached from both ends with no
///      acceleration, lower the hump's cap), and do the same for the pieces.
/// Zones with low limits are settled first, and every new knot lowers the feedrate everywhere, so a
/// zone that was kept stays kept; a hump is the fastest motion between its knots. That is so where
/// a ramp to a lower feedrate is slower everywhere than one to a higher. The ramps of s_curve are
/// not: their jerk is lower for a larger change. There a zone that was kept may have to be lowered
/// below a knot that is settled, which then cannot be reached any more; the limit of that knot is
/// lowered to what can be, and planning starts anew. The limits of the method: a falling or rising
/// staircase of limits is taken one step at a time wherever the steps bind, a = 0 at each, which is
/// feasible but slower than gliding along it.
class Envelope {
 public:
  explicit Envelope(const RampLimits& limits) : limits_(limits) {}

  /// Plans from start to end over zones that cover [start.s, end.s] in ascending order.
  ///
  /// @returns false if the start is too fast for what follows; humps() then means nothing.
  bool plan(std::span<const LimitZone> zones, const Knot& start, const Knot& end);

  /// Result, in path order; the end of one is the start of the next.
  const std::vector<Hump>& humps() const noexcept { return humps_; }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  struct PieceEnd {
    Knot knot;
    std::size_t zone = kNone;  // whose limit the knot keeps; none at the ends of the plan
  };

  struct Piece {
    PieceEnd a;
    PieceEnd b;
    std::size_t first;  // zones [first, last) lie between a and b
    std::size_t last;
    double cap;  // largest feedrate allowed on the piece besides its zones [mm/s]
  };

  bool settle_all(const Knot& start, const Knot& end);
  bool settle(const Piece& piece);
  /// @returns false, with nothing done, where a knot could not be reached
  bool split(const Piece& piece, std::size_t zone, bool enters_fast, bool leaves_fast);
  /// Lowers the limit of the faster knot of a piece that passes a zone too fast.
  /// @returns false, with nothing done, where that is an end of the plan
  bool lower_knot(const Piece& piece, const LimitZone& zone);

  RampLimits limits_;
  std::span<const LimitZone> given_;
  std::span<const LimitZone> zones_;  // given_, or lowered_
  std::vector<LimitZone> lowered_;
  bool is_lowered_ = false;  // since planning started anew
  std::vector<Piece> pending_;
  std::vector<Hump> humps_;
};

}  // namespace twin::feedrate
