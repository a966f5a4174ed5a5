#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "feedrate/limits/zones.hpp"
#include "feedrate/paper/hump.hpp"

namespace twin::feedrate {

/// Jerk-limited feedrate under limits that depend on the place: a chain of humps between anchors.
///
///   limit  ------------.          .-------.     .------------
///                      |   ____   |       |     |
///          ___         '--/----\--'       '-----'   ___
///   feed  /   \          /      \        _______   /   \.
///        /     \________/        \______/       \_/     \.
///       start anchor  anchor     anchor        anchor    end
///
/// Where the limit is lowest, the feedrate should just touch it with no acceleration: an anchor is
/// put there. The part of the path between two anchors is a leg.
///   1. Take one hump from start to end under the largest limit there.
///   2. Find, of all zones in which it is too fast, the one with the lowest limit.
///   3. Put an anchor where the hump enters that zone too fast and one where it leaves it too fast,
///      and plan the new legs in the same way. If the hump is too fast only inside the zone, or if
///      such an anchor cannot be reached from both ends without acceleration, lower the cap of the
///      hump instead.
/// A hump is the fastest motion between its anchors. Zones with low limits come first, and every
/// new anchor lowers the feedrate everywhere, so a zone that was kept stays kept.
///
/// The last holds where a ramp to a lower feedrate is slower everywhere than a ramp to a higher
/// one. The ramps of s_curve are not like that: their jerk is lower for a larger change. A zone
/// that was kept may then have to be lowered below an anchor that stands already and cannot be
/// reached any more. In that case the limit of that anchor is lowered to what can be reached, and
/// planning starts anew.
///
/// The method has a limit: a falling or rising staircase of limits is taken one step at a time
/// wherever the steps bind, with a = 0 at each. That is feasible, but slower than gliding along it.
class Envelope {
 public:
  explicit Envelope(const RampLimits& limits) : limits_(limits) {}

  /// Plans from start to end over zones that cover [start.s, end.s] in ascending order.
  ///
  /// @returns false if the start is too fast for what follows; humps() then means nothing.
  bool plan(std::span<const LimitZone> zones, const Anchor& start, const Anchor& end);

  /// Result, in path order; the end of one is the start of the next.
  const std::vector<Hump>& humps() const noexcept { return humps_; }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  struct LegEnd {
    Anchor anchor;
    std::size_t zone = kNone;  // whose limit the anchor keeps; none at the ends of the plan
  };

  struct Leg {
    LegEnd a;
    LegEnd b;
    std::size_t first;  // zones [first, last) lie between a and b
    std::size_t last;
    double cap;  // largest feedrate allowed on the leg besides its zones [mm/s]
  };

  /// A zone in which a hump is too fast, and on which part of the path it is.
  struct Violation {
    std::size_t zone;
    Interval fast;
  };

  enum class Outcome : std::uint8_t {
    kPlanned,     // the whole path has its humps
    kStartAnew,   // the limit of an anchor was lowered
    kImpossible,  // the start is too fast
  };

  Outcome plan_legs(const Anchor& start, const Anchor& end);
  Outcome plan_leg(const Leg& leg);
  std::optional<Violation> find_violation(const Leg& leg, const Hump& hump) const;
  /// Whether the leg was split at the zone; if an anchor there could not be reached nothing is
  /// done.
  bool split(const Leg& leg, const Violation& violation);
  /// Lowers the limit of the faster anchor of a leg that passes a zone too fast.
  Outcome lower_anchor(const Leg& leg, const LimitZone& zone);

  RampLimits limits_;
  std::span<const LimitZone> given_;
  std::span<const LimitZone> zones_;  // given_, or lowered_
  std::vector<LimitZone> lowered_;
  std::vector<Leg> pending_;
  std::vector<Hump> humps_;
};

}  // namespace twin::feedrate
