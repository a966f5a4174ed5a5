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
/// An anchor is a place that is passed at a given feedrate without acceleration. Anchors are put
/// where the limit is lowest, so that the feedrate just touches the limit. The part of the path
/// between two anchors is a leg. A hump is the fastest motion along a leg: up, constant, down.
///   1. Take one hump from start to end under the largest limit there.
///   2. Find, of all zones in which it is too fast, the one with the lowest limit.
///   3. If the hump is too fast at the begin or at the end of that zone, put an anchor there, and
///      plan the new legs in the same way. If the hump is too fast only inside the zone, or if such
///      an anchor cannot be reached from both ends of the leg, lower the cap of the hump instead.
/// Zones with low limits come first, and every new anchor lowers the feedrate everywhere. So a zone
/// whose limit is kept once stays so.
///
/// This last argument needs a profile whose ramp to a lower feedrate is slower everywhere than its
/// ramp to a higher one. The profile s_curve does not have this property, because it uses less jerk
/// for a larger change. An existing anchor may then be too fast to be reached. In that case the
/// limit of the anchor is lowered to what can be reached, and planning starts anew.
///
/// The method has a weakness: it takes a staircase of limits one step at a time, with a = 0 at each
/// step. That keeps all limits, but is slower than one ramp along the whole staircase (see Glide).
class Envelope {
 public:
  explicit Envelope(const RampLimits& limits) : limits_(limits) {}

  /// Plans from start to end over zones that cover [start.s, end.s] in ascending order.
  ///
  /// @returns false if the start is too fast for the limits after it; humps() is then undefined
  bool plan(std::span<const LimitZone> zones, const Anchor& start, const Anchor& end);

  /// The planned humps in path order. Each one begins where the one before ends.
  const std::vector<Hump>& humps() const noexcept { return humps_; }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  struct LegEnd {
    Anchor anchor;
    std::size_t zone = kNone;  // zone that the anchor was put for; kNone at the ends of the plan
  };

  struct Leg {
    LegEnd a;
    LegEnd b;
    std::size_t first;  // zones [first, last) lie between a and b
    std::size_t last;
    double cap;  // largest feedrate on the leg, in addition to the limits of its zones [mm/s]
  };

  /// A zone in which a hump is too fast, and the part of the path on which it is.
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
  /// Splits the leg by anchors at the zone.
  /// @returns false, with nothing done, if such an anchor cannot be reached
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
