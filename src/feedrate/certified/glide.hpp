#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "feedrate/certified/ascent.hpp"
#include "feedrate/certified/summit.hpp"
#include "feedrate/certified/zone_ascent.hpp"
#include "feedrate/certified/zone_lows.hpp"
#include "feedrate/limits/zones.hpp"

namespace twin::feedrate {

/// Jerk-limited feedrate under limits that depend on the place: summits between anchors, with
/// anchors only in the valleys of the limits.
///
///   limit  ---.              .--------.
///             '-.   ____   .-'        '-.      ____
///   feed   ___  '-./    \.-'   ______    '-.--'
///             \.__/      \.___/      \.____/
///                anchor     anchor      anchor
///
/// An anchor is a place that is passed at a given feedrate without acceleration. The part of the
/// path between two anchors is a leg. A summit is the motion along a leg: an ascent from one anchor
/// that meets a descent to the other.
///   1. Take one summit from start to end.
///   2. Find, of all zones in which it is too fast, the one with the lowest limit.
///   3. If the motion can reach the limit of that zone without acceleration from both sides, the
///      zone is a valley. Put anchors at its begin and at its end, and plan the new legs in the
///      same way. If not, the zone lies on the ascent or on the descent. Clamp that one to the
///      limit of the zone up to the far end of the zone, which it passes with acceleration. If the
///      zone lies on neither, its limit caps the whole leg.
/// Zones with low limits come first, and each step lowers the feedrate everywhere. So a zone whose
/// limit is kept once stays so. Zones that are treated later have higher limits than every anchor,
/// so anchors can always be reached, and from rest there is always a plan.
///
/// Where zones have their own acceleration and jerk the rises are ZoneAscents. Should no plan be
/// found for them, the whole is planned once more with the least acceleration and jerk of all zones.
class Glide {
 public:
  /// One summit of the result.
  struct Part {
    std::size_t first;    ///< index of its first phase in phases()
    std::size_t descent;  ///< index of the first phase of its descent
  };

  /// Plans from start to end over zones that cover [start.s, end.s] in ascending order.
  ///
  /// @param ramp  limits of the machine; zones may allow less acceleration and jerk
  /// @returns false if the start is too fast for the limits after it; the result is then undefined
  bool plan(std::span<const LimitZone> zones, const Anchor& start, const Anchor& end,
            const RampLimits& ramp);

  /// The planned motion in path order, and the summits that it consists of.
  const std::vector<Phase>& phases() const noexcept { return phases_; }
  const std::vector<Part>& parts() const noexcept { return parts_; }
  /// The places where the legs end, in path order [mm].
  const std::vector<double>& leg_ends() const noexcept { return leg_ends_; }
  /// Whether the least acceleration and jerk of all zones had to do for all of them.
  bool is_even() const noexcept { return is_even_; }

 private:
  struct Leg {
    Anchor a;
    Anchor b;
    Rise* up;           // from a; null where the feedrate is constant from a to b
    Rise* down;         // backward from b; null as above
    std::size_t first;  // zones [first, last) lie between a and b
    std::size_t last;
    double cap = std::numeric_limits<double>::infinity();
  };
  /// The summit of the leg that is being planned.
  struct Climb {
    std::vector<Phase> phases;
    std::size_t descent = 0;  // first phase of the descent
    double turn = 0.0;        // place where the descent begins [mm]
    double peak = 0.0;        // highest feedrate [mm/s]
    bool is_joined = false;   // false: the start is too fast, and only the descent is there
  };
  struct Violation {
    std::size_t zone;
    bool enters;  // too fast where the zone begins
    bool leaves;  // too fast where it ends
  };
  enum class Resolution : std::uint8_t { kSplit, kLowered, kImpossible };

  Rise* rise_from(const Anchor& anchor, Sense sense, std::size_t zone);
  void release(const Leg& leg);
  RampLimits least_ramp() const;
  double way_down(double from, double s, double v, Sense sense, std::size_t zone);
  bool plan_legs(const Anchor& start, const Anchor& end);
  bool plan_leg(Leg leg);
  std::optional<std::size_t> certain_valley(const Leg& leg) const;
  void climb(const Leg& leg);
  std::optional<Violation> find_violation(const Leg& leg) const;
  std::optional<std::size_t> lowest_violated(const Leg& leg) const;
  std::size_t phase_at(double s, std::size_t from) const;
  bool is_faster(std::size_t phase, double s, double limit) const;
  Resolution resolve(Leg& leg, const Violation& violation);
  void split(const Leg& leg, std::size_t zone);

  std::span<const LimitZone> zones_;
  ZoneLows lows_;
  RampLimits ramp_{};
  bool has_zone_ramps_ = false;
  double ceiling_ = 0.0;
  bool is_even_ = false;
  std::deque<Ascent> ascents_;
  std::deque<ZoneAscent> zone_ascents_;
  std::vector<Rise*> free_;  // of the kind that is in use
  std::vector<Leg> pending_;
  Climb climb_;
  std::vector<Phase> phases_;
  std::vector<Part> parts_;
  std::vector<double> leg_ends_;
};

}  // namespace twin::feedrate
