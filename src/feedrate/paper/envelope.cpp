#include "feedrate/paper/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

/// How often limits may be lowered, for each zone, before planning gives up. It is there so that
/// planning ends; twice as many would only make a plan that fails take twice as long.
constexpr std::size_t kLowerings = 4;

double highest_limit(std::span<const LimitZone> zones, double from, double to) {
  double highest = 0.0;
  for (const LimitZone& zone : zones) {
    if (std::min(zone.end, to) - std::max(zone.begin, from) > kPlaceRounding) {
      highest = std::max(highest, zone.limit);
    }
  }
  return highest;
}

bool is_inside(double s, const Interval& interval) {
  return s > interval.begin + kPlaceRounding && s < interval.end - kPlaceRounding;
}

}  // namespace

bool Envelope::plan(std::span<const LimitZone> zones, const Anchor& start, const Anchor& end) {
  given_ = zones_ = zones;
  if (!is_reachable(start, end, limits_)) {
    return false;
  }
  for (std::size_t lowered = 0; lowered <= kLowerings * zones.size(); ++lowered) {
    const Outcome outcome = plan_legs(start, end);
    if (outcome != Outcome::kStartAnew) {
      return outcome == Outcome::kPlanned;
    }
  }
  return false;
}

Envelope::Outcome Envelope::plan_legs(const Anchor& start, const Anchor& end) {
  humps_.clear();
  pending_.clear();
  pending_.push_back({{start}, {end}, 0, zones_.size(), std::numeric_limits<double>::infinity()});
  while (!pending_.empty()) {
    const Leg leg = pending_.back();
    pending_.pop_back();
    if (const Outcome outcome = plan_leg(leg); outcome != Outcome::kPlanned) {
      return outcome;
    }
  }
  return Outcome::kPlanned;
}

/// Gives a leg its hump, or leaves what it becomes pending.
Envelope::Outcome Envelope::plan_leg(const Leg& leg) {
  const Anchor& a = leg.a.anchor;
  const Anchor& b = leg.b.anchor;
  const auto zones = zones_.subspan(leg.first, leg.last - leg.first);
  const double cap = std::min(leg.cap, highest_limit(zones, a.s, b.s));
  const Hump hump = make_hump(a, b, cap, limits_);
  const auto violation = find_violation(leg, hump);
  if (!violation) {
    humps_.push_back(hump);
    return Outcome::kPlanned;
  }
  if (split(leg, *violation)) {
    return Outcome::kPlanned;
  }
  const LimitZone& zone = zones_[violation->zone];
  if (zone.limit < std::max(a.v, b.v) * (1.0 - kFeedrateRounding)) {
    return lower_anchor(leg, zone);
  }
  Leg lower = leg;
  lower.cap = zone.limit;
  pending_.push_back(lower);
  return Outcome::kPlanned;
}

/// The zone of the lowest limit, of all those in which a hump is too fast.
std::optional<Envelope::Violation> Envelope::find_violation(const Leg& leg,
                                                            const Hump& hump) const {
  std::optional<Violation> worst;
  for (std::size_t i = leg.first; i < leg.last; ++i) {
    const LimitZone& zone = zones_[i];
    if (zone.limit >= hump.peak * (1.0 - kFeedrateRounding) ||
        (worst && zone.limit >= zones_[worst->zone].limit)) {
      continue;
    }
    const Interval fast = faster_than(hump, zone.limit, limits_);
    if (zone.end > fast.begin + kPlaceRounding && zone.begin < fast.end - kPlaceRounding) {
      worst = Violation{i, fast};
    }
  }
  return worst;
}

Envelope::Outcome Envelope::lower_anchor(const Leg& leg, const LimitZone& zone) {
  const bool is_a = leg.a.anchor.v > leg.b.anchor.v;
  const auto& [fast, owner] = is_a ? leg.a : leg.b;
  const Anchor& slow = is_a ? leg.b.anchor : leg.a.anchor;
  if (owner == kNone) {
    return Outcome::kImpossible;
  }
  // From the slower anchor to the zone's far side, and from there to the place of the faster one.
  const double side = is_a ? zone.begin : zone.end;
  const double between = std::min(zone.limit, ramp_reach(slow.v, std::abs(side - slow.s), limits_));
  const double reached = ramp_reach(between, std::abs(fast.s - side), limits_);
  const double allowed = reached < fast.v ? reached : zone.limit;
  if (zones_.data() != lowered_.data()) {
    lowered_.assign(zones_.begin(), zones_.end());
    zones_ = lowered_;
  }
  double& limit = lowered_[owner].limit;
  limit = std::min(limit, allowed);
  return Outcome::kStartAnew;
}

bool Envelope::split(const Leg& leg, const Violation& violation) {
  const std::size_t index = violation.zone;
  const LimitZone& zone = zones_[index];
  const bool enters_fast = is_inside(zone.begin, violation.fast);
  const bool leaves_fast = is_inside(zone.end, violation.fast);
  if (!enters_fast && !leaves_fast) {
    return false;
  }
  const Anchor& a = leg.a.anchor;
  const Anchor& b = leg.b.anchor;
  Anchor in{zone.begin, std::min(zone.limit, ramp_reach(a.v, zone.begin - a.s, limits_))};
  Anchor out{zone.end, std::min(zone.limit, ramp_reach(b.v, b.s - zone.end, limits_))};
  const bool is_place = zone.end - zone.begin <= kPlaceRounding;
  if (is_place) {
    in.v = out.v = std::min(in.v, out.v);
    out.s = in.s;
  } else if (enters_fast && leaves_fast) {
    in.v = std::min(in.v, ramp_reach(out.v, zone.end - zone.begin, limits_));
    out.v = std::min(out.v, ramp_reach(in.v, zone.end - zone.begin, limits_));
  } else if (enters_fast) {
    in.v = std::min(in.v, ramp_reach(b.v, b.s - in.s, limits_));
  } else {
    out.v = std::min(out.v, ramp_reach(a.v, out.s - a.s, limits_));
  }
  in.is_at_limit = in.v == given_[index].limit;
  out.is_at_limit = out.v == given_[index].limit;
  // Legs are pushed last first, so that they are planned in path order.
  if (enters_fast && leaves_fast) {
    if (!is_reachable(a, in, limits_) || !is_reachable(out, b, limits_)) {
      return false;
    }
    pending_.push_back({{out, index}, leg.b, index + 1, leg.last, leg.cap});
    if (!is_place) {
      pending_.push_back({{in, index}, {out, index}, index, index + 1, leg.cap});
    }
    pending_.push_back({leg.a, {in, index}, leg.first, index, leg.cap});
    return true;
  }
  const LegEnd end{enters_fast ? in : out, index};
  const std::size_t border = enters_fast ? index : index + 1;
  if (!is_reachable(a, end.anchor, limits_) || !is_reachable(end.anchor, b, limits_)) {
    return false;
  }
  pending_.push_back({end, leg.b, border, leg.last, leg.cap});
  pending_.push_back({leg.a, end, leg.first, border, leg.cap});
  return true;
}

}  // namespace twin::feedrate
