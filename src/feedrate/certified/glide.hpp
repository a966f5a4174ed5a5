#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <span>
#include <vector>

#include "feedrate/certified/ascent.hpp"
#include "feedrate/certified/summit.hpp"
#include "feedrate/limits/limit_zone.hpp"

namespace twin::feedrate {

/// Jerk-limited feedrate under limits that depend on the place: summits between knots, and knots
/// only in the valleys of the limits.
///
///   limit  ---.              .--------.
///             '-.   ____   .-'        '-.      ____
///   feed   ___  '-./    \.-'   ______    '-.--'
///             \.__/      \.___/      \.____/
///                 knot       knot          knot
///
/// 1. Take one summit from start to end.
/// 2. Find, of all zones in which it is too fast, the one with the lowest limit.
/// 3. Where both sides have room to come to its limit with no acceleration, it is a valley: knots
///    where it begins and ends, and the same for the pieces. Else it is on the way up of one side
///    or on the way down of the other: that ascent is kept under its limit up to its far end, which
///    it then passes with acceleration. Else it is the highest feedrate of the piece.
/// Zones with low limits are settled first and each step lowers the feedrate everywhere, so a zone
/// that was kept stays kept, and a knot, whose limit is no higher than those still to be settled,
/// can always be reached. From rest there is always a plan.
class Glide {
 public:
  /// One summit of the result.
  struct Part {
    std::size_t first;    ///< its first phase
    std::size_t descent;  ///< first phase of its descent
  };

  /// Plans from start to end over zones that cover [start.s, end.s] in ascending order.
  ///
  /// @param ramp  of the machine; zones may allow less
  /// @returns false if the start is too fast for what follows; the result then means nothing
  bool plan(std::span<const LimitZone> zones, const Knot& start, const Knot& end,
            const RampLimits& ramp);

  /// Result, in path order.
  const std::vector<Phase>& phases() const noexcept { return phases_; }
  const std::vector<Part>& parts() const noexcept { return parts_; }

 private:
  struct Piece {
    Knot a;
    Knot b;
    Ascent* up;  // from a; null where the feedrate is held from a to b
    Ascent* down;
    std::size_t first;  // zones [first, last) lie between a and b
    std::size_t last;
    RampLimits ramp;
    double cap = std::numeric_limits<double>::infinity();
  };
  struct Violation {
    std::size_t zone;
    bool enters;  // too fast where the zone begins
    bool leaves;  // too fast where it ends
  };

  Ascent* ascent_from(const Knot& knot, Sense sense, std::size_t zone, const RampLimits& ramp);
  void give_back(Piece& piece);
  RampLimits ramp_of(std::size_t first, std::size_t last) const;
  bool settle(Piece piece);
  bool climb(const Piece& piece);
  bool find_violation(const Piece& piece, Violation& worst) const;
  bool is_faster(double s, double limit, std::size_t& phase) const;
  bool resolve(Piece& piece, const Violation& violation, bool& is_split);
  void split(Piece& piece, std::size_t zone);

  std::span<const LimitZone> zones_;
  RampLimits ramp_{};
  bool has_zone_ramps_ = false;
  double ceiling_ = 0.0;
  std::deque<Ascent> ascents_;
  std::vector<Ascent*> free_;
  std::vector<Piece> pending_;
  std::vector<Phase> summit_;  // of the piece at hand
  std::size_t descent_ = 0;    // its first phase of the descent
  double turn_ = 0.0;          // place where its descent begins [mm]
  double peak_ = 0.0;          // its highest feedrate [mm/s]
  std::vector<Phase> phases_;
  std::vector<Part> parts_;
};

}  // namespace twin::feedrate
