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
/// The part of the path between two anchors is a leg.
///   1. Take one summit from start to end.
///   2. Find, of all zones in which it is too fast, the one with the lowest limit.
///   3. If both sides have room to come to that limit without acceleration, the zone is a valley.
///      Anchors are put where it begins and where it ends, and the new legs are planned in the same
///      way. If not, the zone lies on the way up of one side or on the way down of the other. That
///      ascent is then clamped to the zone's limit up to the zone's far end, which it passes with
///      acceleration. If the zone lies on neither, its limit caps the whole leg.
/// Zones with low limits come first and each step lowers the feedrate everywhere, so a zone that
/// was kept stays kept. An anchor is no faster than the limits of zones that come later, so it can
/// always be reached. From rest there is always a plan.
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
  bool plan(std::span<const LimitZone> zones, const Anchor& start, const Anchor& end,
            const RampLimits& ramp);

  /// Result, in path order.
  const std::vector<Phase>& phases() const noexcept { return phases_; }
  const std::vector<Part>& parts() const noexcept { return parts_; }

 private:
  struct Leg {
    Anchor a;
    Anchor b;
    Ascent* up;  // from a; null where the feedrate is held from a to b
    Ascent* down;
    std::size_t first;  // zones [first, last) lie between a and b
    std::size_t last;
    RampLimits ramp;
    double cap = std::numeric_limits<double>::infinity();
  };
  /// The summit of the leg at hand.
  struct Climb {
    std::vector<Phase> phases;
    std::size_t descent = 0;  // first phase of the descent
    double turn = 0.0;        // place where the descent begins [mm]
    double peak = 0.0;        // highest feedrate [mm/s]
    bool is_joined = false;  // else the start is too fast, and this is the descent to the end alone
  };
  struct Violation {
    std::size_t zone;
    bool enters;  // too fast where the zone begins
    bool leaves;  // too fast where it ends
  };
  enum class Resolution : std::uint8_t { kSplit, kLowered, kImpossible };

  Ascent* ascent_from(const Anchor& anchor, Sense sense, std::size_t zone, const RampLimits& ramp);
  void release(const Leg& leg);
  RampLimits ramp_of(std::size_t first, std::size_t last) const;
  bool plan_leg(Leg leg);
  void climb(const Leg& leg);
  std::optional<Violation> find_violation(const Leg& leg) const;
  std::optional<std::size_t> lowest_violated(const Leg& leg) const;
  std::size_t phase_at(double s, std::size_t from) const;
  bool is_faster(std::size_t phase, double s, double limit) const;
  Resolution resolve(Leg& leg, const Violation& violation);
  void split(const Leg& leg, std::size_t zone);

  std::span<const LimitZone> zones_;
  RampLimits ramp_{};
  bool has_zone_ramps_ = false;
  double ceiling_ = 0.0;
  std::deque<Ascent> ascents_;
  std::vector<Ascent*> free_;
  std::vector<Leg> pending_;
  Climb climb_;
  std::vector<Phase> phases_;
  std::vector<Part> parts_;
};

}  // namespace twin::feedrate
