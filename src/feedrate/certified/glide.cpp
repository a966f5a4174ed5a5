#include "feedrate/certified/glide.hpp"

#include <algorithm>
#include <cmath>

#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

const Ascent kNoAscent;

/// How often a leg may be lowered, for each of its zones, before planning gives up. It is there so
/// that planning ends; twice as many would only make a plan that fails take twice as long.
constexpr std::size_t kStepsPerZone = 8;

/// Anchors at one place have one feedrate [-]: their difference is rounding of the plan, and what
/// it would take to pass from one to the other is far below what a period shows.
constexpr double kSamePlaceFeedrate = 1e-6;

/// Whether a phase that rises passes a place faster than a limit.
bool is_faster_rising(const Phase& phase, double s, double limit) {
  if (phase.v > limit * (1.0 + kFeedrateRounding)) {
    return true;
  }
  if (motion_at(phase, phase.duration).v <= limit * (1.0 + kFeedrateRounding)) {
    return false;
  }
  const double gain = std::max(limit - phase.v, 0.0);
  const double root = std::sqrt(std::max(phase.a * phase.a + 2.0 * phase.j * gain, 0.0));
  const double t = gain > 0.0 ? 2.0 * gain / (phase.a + root) : 0.0;
  return motion_at(phase, t).s < s;
}

/// Whether a phase that falls passes a place faster than a limit.
bool is_faster_falling(const Phase& phase, double s, double limit) {
  if (phase.v <= limit * (1.0 + kFeedrateRounding)) {
    return false;
  }
  if (motion_at(phase, phase.duration).v > limit * (1.0 + kFeedrateRounding)) {
    return true;
  }
  const double loss = std::max(phase.v - limit, 0.0);
  const double root = std::sqrt(std::max(phase.a * phase.a - 2.0 * phase.j * loss, 0.0));
  const double t = loss > 0.0 ? std::min(2.0 * loss / (root - phase.a), phase.duration) : 0.0;
  return motion_at(phase, t).s > s;
}

}  // namespace

bool Glide::plan(std::span<const LimitZone> zones, const Anchor& start, const Anchor& end,
                 const RampLimits& ramp) {
  zones_ = zones;
  ramp_ = ramp;
  ceiling_ = std::max(start.v, end.v);
  has_zone_ramps_ = false;
  for (const LimitZone& zone : zones) {
    ceiling_ = std::max(ceiling_, zone.limit);
    has_zone_ramps_ = has_zone_ramps_ || zone.acceleration < ramp.acceleration ||
                      zone.deceleration < ramp.acceleration || zone.jerk < ramp.jerk;
  }
  is_even_ = false;
  if (plan_legs(start, end)) {
    return true;
  }
  if (!has_zone_ramps_) {
    return false;
  }
  ramp_ = least_ramp();
  has_zone_ramps_ = false;
  is_even_ = true;
  return plan_legs(start, end);
}

bool Glide::plan_legs(const Anchor& start, const Anchor& end) {
  phases_.clear();
  parts_.clear();
  leg_ends_.clear();
  pending_.clear();
  free_.clear();
  if (has_zone_ramps_) {
    for (ZoneAscent& ascent : zone_ascents_) {
      free_.push_back(&ascent);
    }
  } else {
    for (Ascent& ascent : ascents_) {
      free_.push_back(&ascent);
    }
  }
  Rise* up = rise_from(start, Sense::kForward, 0);
  Rise* down = rise_from(end, Sense::kBackward, zones_.size() - 1);
  pending_.push_back({start, end, up, down, 0, zones_.size()});
  while (!pending_.empty()) {
    const Leg leg = pending_.back();
    pending_.pop_back();
    if (!plan_leg(leg)) {
      return false;
    }
  }
  return true;
}

RampLimits Glide::least_ramp() const {
  RampLimits least = ramp_;
  for (const LimitZone& zone : zones_) {
    least.acceleration = std::min({least.acceleration, zone.acceleration, zone.deceleration});
    least.jerk = std::min(least.jerk, zone.jerk);
  }
  return least;
}

Rise* Glide::rise_from(const Anchor& anchor, Sense sense, std::size_t zone) {
  if (has_zone_ramps_) {
    ZoneAscent* ascent =
        free_.empty() ? &zone_ascents_.emplace_back() : static_cast<ZoneAscent*>(free_.back());
    if (!free_.empty()) {
      free_.pop_back();
    }
    ascent->start(zones_, zone, anchor, sense, ramp_, ceiling_);
    return ascent;
  }
  Ascent* ascent = free_.empty() ? &ascents_.emplace_back() : static_cast<Ascent*>(free_.back());
  if (!free_.empty()) {
    free_.pop_back();
  }
  ascent->start(zones_, zone, anchor, sense, ramp_, ceiling_);
  return ascent;
}

/// Distance that a descent takes, without acceleration at its ends [mm].
/// @param from   feedrate at its beginning [mm/s]
/// @param s, v   its end
/// @param sense  in which the rise from its end to its beginning goes
/// @param zone   the first zone of that rise
double Glide::way_down(double from, double s, double v, Sense sense, std::size_t zone) {
  if (!has_zone_ramps_) {
    return ramp_distance(from, v, ramp_);
  }
  Rise* rise = rise_from({s, v}, sense, zone);
  while (!rise->is_complete() && rise->top() < from) {
    rise->extend();
  }
  const double distance =
      rise->top() < from ? std::numeric_limits<double>::infinity() : rise->exit_at(from).distance;
  free_.push_back(rise);
  return distance;
}

void Glide::release(const Leg& leg) {
  free_.push_back(leg.up);
  free_.push_back(leg.down);
}

/// Appends the phases of a leg, or leaves the legs that it is split into pending.
/// @returns false where the start is too fast
bool Glide::plan_leg(Leg leg) {
  const double length = leg.b.s - leg.a.s;
  if (leg.up == nullptr) {
    phases_.push_back({length / leg.a.v, leg.a.s, leg.a.v, 0.0, 0.0});
    leg_ends_.push_back(leg.b.s);
    return true;
  }
  if (length <= kPlaceRounding) {
    release(leg);
    return std::abs(leg.a.v - leg.b.v) <= kSamePlaceFeedrate * (1.0 + leg.a.v);
  }
  for (std::size_t i = 0; i <= kStepsPerZone * (leg.last - leg.first) + 8; ++i) {
    climb(leg);
    const auto worst = find_violation(leg);
    if (!worst) {
      if (climb_.is_joined) {
        parts_.push_back({phases_.size(), phases_.size() + climb_.descent});
        phases_.insert(phases_.end(), climb_.phases.begin(), climb_.phases.end());
        leg_ends_.push_back(leg.b.s);
        release(leg);
      }
      return climb_.is_joined;
    }
    switch (resolve(leg, *worst)) {
      case Resolution::kImpossible:
        return false;
      case Resolution::kSplit:
        return true;
      case Resolution::kLowered:
        break;
    }
  }
  return false;
}

/// Finds the summit of a leg. Where its start is too fast for one, the descent to its end is taken
/// alone: a zone that it does not keep may be a valley that can be reached.
void Glide::climb(const Leg& leg) {
  const double v_least = std::max(leg.a.v, leg.b.v);
  auto joined = join(*leg.up, *leg.down, leg.b.s - leg.a.s, v_least, std::max(leg.cap, v_least));
  Summit summit;
  if (joined) {
    summit = *joined;
  } else {
    summit.v = std::min(leg.a.v, leg.down->top());
    summit.up = {.phase = 0, .time = 0.0, .at = {0.0, summit.v, 0.0}, .distance = 0.0};
    summit.down = leg.down->exit_at(summit.v);
    summit.length = summit.down.distance;
  }
  climb_.phases.clear();
  const Rise& up = joined ? static_cast<const Rise&>(*leg.up) : kNoAscent;
  climb_.descent = append_phases(summit, up, *leg.down, leg.b.s - summit.length, climb_.phases);
  climb_.turn = climb_.descent < climb_.phases.size() ? climb_.phases[climb_.descent].s : leg.b.s;
  climb_.peak = summit.v;
  climb_.is_joined = joined.has_value();
}

/// The phase of the summit at hand with a place.
/// @param from  a phase that is not beyond it
std::size_t Glide::phase_at(double s, std::size_t from) const {
  while (from + 1 < climb_.phases.size() && climb_.phases[from + 1].s <= s) {
    ++from;
  }
  return from;
}

/// Whether the summit at hand passes a place, which lies in a phase, faster than a limit. The place
/// is known to kPlaceRounding, within which the next phase may begin.
bool Glide::is_faster(std::size_t phase, double s, double limit) const {
  if (phase >= climb_.descent) {
    const double place = s + kPlaceRounding;
    return is_faster_falling(climb_.phases[phase_at(place, phase)], place, limit);
  }
  const double place = s - kPlaceRounding;
  while (phase > 0 && climb_.phases[phase].s > place) {
    --phase;
  }
  return is_faster_rising(climb_.phases[phase], place, limit);
}

/// The zone of the lowest limit that the summit at hand does not keep; of several, the middle one.
std::optional<std::size_t> Glide::lowest_violated(const Leg& leg) const {
  const std::size_t middle = leg.first + (leg.last - leg.first) / 2;
  const auto off = [&](std::size_t i) { return i > middle ? i - middle : middle - i; };
  std::optional<std::size_t> worst;
  std::size_t phase = 0;
  for (std::size_t i = leg.first; i < leg.last; ++i) {
    const LimitZone& zone = zones_[i];
    if (zone.limit * (1.0 + kFeedrateRounding) >= climb_.peak) {
      continue;
    }
    if (worst && (zone.limit > zones_[*worst].limit ||
                  (zone.limit == zones_[*worst].limit && off(i) > off(*worst)))) {
      continue;
    }
    const double begin = std::max(zone.begin, leg.a.s);
    const double end = std::min(zone.end, leg.b.s);
    bool is_fast = true;  // with the highest feedrate in the zone
    if (end <= climb_.turn || begin >= climb_.turn) {
      const double s = end <= climb_.turn ? end : begin;
      phase = phase_at(s, phase);
      is_fast = is_faster(phase, s, zone.limit);
    }
    if (is_fast) {
      worst = i;
    }
  }
  return worst;
}

std::optional<Glide::Violation> Glide::find_violation(const Leg& leg) const {
  const auto worst = lowest_violated(leg);
  if (!worst) {
    return std::nullopt;
  }
  const LimitZone& zone = zones_[*worst];
  const auto is_fast_at = [&](double s) {
    return s > leg.a.s + kPlaceRounding && s < leg.b.s - kPlaceRounding &&
           is_faster(phase_at(s, 0), s, zone.limit);
  };
  return Violation{*worst, is_fast_at(zone.begin), is_fast_at(zone.end)};
}

Glide::Resolution Glide::resolve(Leg& leg, const Violation& violation) {
  const LimitZone& zone = zones_[violation.zone];
  const double v = zone.limit;
  const double room_up = zone.begin - leg.a.s;
  const double room_down = leg.b.s - zone.end;
  bool is_on_way_up = violation.leaves;
  bool is_on_way_down = violation.enters;
  if (violation.enters && violation.leaves) {
    const double way_in =
        v < leg.a.v ? way_down(leg.a.v, zone.begin, v, Sense::kBackward, violation.zone - 1)
                    : leg.up->exit_at(v).distance;
    const bool has_in = way_in <= room_up + kPlaceRounding;
    const double way_out = v < leg.b.v
                               ? way_down(leg.b.v, zone.end, v, Sense::kForward, violation.zone + 1)
                               : leg.down->exit_at(v).distance;
    const bool has_out = way_out <= room_down + kPlaceRounding;
    if (has_in && has_out) {
      split(leg, violation.zone);
      return Resolution::kSplit;
    }
    is_on_way_up = !has_in && (has_out || zone.end <= climb_.turn);
    is_on_way_down = !has_out && (has_in || zone.begin >= climb_.turn);
  }
  if (is_on_way_down && v >= leg.b.v) {
    leg.down->lower(leg.b.s - zone.begin, v);
  } else if (is_on_way_up && v >= leg.a.v) {
    leg.up->lower(zone.end - leg.a.s, v);
  } else if (v >= std::max(leg.a.v, leg.b.v)) {
    leg.cap = std::min(leg.cap, v);
  } else {
    return Resolution::kImpossible;
  }
  return Resolution::kLowered;
}

/// Splits a leg at a valley: the leg before it, the hold in it, the leg after it.
void Glide::split(const Leg& leg, std::size_t index) {
  const LimitZone& zone = zones_[index];
  const bool is_place = zone.end - zone.begin <= kPlaceRounding;
  const Anchor in{zone.begin, zone.limit};
  const Anchor out{is_place ? zone.begin : zone.end, zone.limit};
  Leg left{leg.a, in, leg.up, nullptr, leg.first, index};
  Leg right{out, leg.b, nullptr, leg.down, index + 1, leg.last};
  left.cap = right.cap = leg.cap;
  left.down = rise_from(in, Sense::kBackward, index - 1);
  right.up = rise_from(out, Sense::kForward, index + 1);
  // Legs are pushed last first, so that they are planned in path order.
  pending_.push_back(right);
  if (!is_place) {
    pending_.push_back({in, out, nullptr, nullptr, index, index + 1});
  }
  pending_.push_back(left);
}

}  // namespace twin::feedrate
