#include "feedrate/certified/passage_glide.hpp"

#include <algorithm>
#include <cmath>

#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

/// Halvings of the range of a feedrate where it takes a plan to know whether it can be reached.
constexpr int kPlannedHalvings = 24;

}  // namespace

std::size_t PassageGlide::last_free_part() const noexcept {
  const auto& all = phases();
  std::size_t last = parts().size() - 1;
  while (last > 0 && all[parts()[last].first].s >= free_end_ - kPlaceRounding) {
    --last;
  }
  return last;
}

bool PassageGlide::plan(std::span<const LimitZone> zones, const Anchor& start, const Anchor& end,
                        const RampLimits& ramp) {
  free_end_ = end.s;
  first_after_passage_ = 0;
  has_passages_ = std::any_of(zones.begin(), zones.end(), is_passage);
  if (!has_passages_) {
    return glide_.plan(zones, start, end, ramp);
  }
  ramp_ = ramp;
  zones_.assign(zones.begin(), zones.end());
  find_passages(start, end);
  while (!compose(start, end)) {  // each turn makes one passage slow, or ends
    if (held_.empty() || (held_.size() == 1 && held_.front().is_start)) {
      return false;
    }
    make_slow(held_.size() - 1, true);
  }
  return true;
}

/// The passages that are to be held, each at its limit.
void PassageGlide::find_passages(const Anchor& start, const Anchor& end) {
  held_.clear();
  for (std::size_t i = 0; i < zones_.size(); ++i) {
    LimitZone& zone = zones_[i];
    if (!is_passage(zone)) {
      continue;
    }
    const bool has_start = zone.begin <= start.s + kPlaceRounding;
    held_.push_back({i, has_start ? start.v : zone.limit, false, has_start});
    const bool has_end = zone.end > end.s + kPlaceRounding;
    if (has_end || held_.back().v <= zone.held_above * (1.0 + kFeedrateRounding)) {
      make_slow(held_.size() - 1, has_end);
    }
  }
}

/// Lets the feedrate change in a passage, which is then as slow as that takes. @returns true
bool PassageGlide::make_slow(std::size_t held, bool is_by_end) {
  LimitZone& zone = zones_[held_[held].zone];
  zone.limit = std::min(zone.limit, zone.held_above);
  if (is_by_end || held_[held].is_slowed) {
    free_end_ = std::min(free_end_, zone.begin);
  }
  held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(held));
  return true;
}

/// Where the plan comes to a passage, or to its end.
Anchor PassageGlide::begin_of(std::size_t held, const Anchor& end) const {
  return held < held_.size() ? Anchor{zones_[held_[held].zone].begin, held_[held].v} : end;
}

/// Where the plan goes on after the passage before, or starts.
Anchor PassageGlide::end_of(std::size_t held, const Anchor& start) const {
  return held > 0 ? Anchor{zones_[held_[held - 1].zone].end, held_[held - 1].v} : start;
}

std::span<const LimitZone> PassageGlide::zones_between(const Anchor& from, const Anchor& to) const {
  const auto first = std::partition_point(zones_.begin(), zones_.end(), [&](const LimitZone& zone) {
    return zone.end <= from.s + kPlaceRounding;
  });
  const auto last = std::partition_point(first, zones_.end(), [&](const LimitZone& zone) {
    return zone.begin < to.s - kPlaceRounding;
  });
  return {first, last};
}

/// Highest feedrate, at most `most`, at the one of two places that is the faster one, from or to
/// which the feedrate v at the other one can be had [mm/s].
double PassageGlide::reach(double v, const Anchor& from, const Anchor& to, double most) {
  const double room = to.s - from.s;
  if (room <= kPlaceRounding) {
    return v;
  }
  const auto zones = zones_between(from, to);
  const bool is_plain = std::all_of(zones.begin(), zones.end(), [&](const LimitZone& zone) {
    return zone.limit >= most && zone.acceleration >= ramp_.acceleration &&
           zone.deceleration >= ramp_.acceleration && zone.jerk >= ramp_.jerk;
  });
  if (is_plain) {
    return std::min(most, std::max(ramp_reach(v, room, ramp_), v));
  }
  const bool is_rise = from.v < to.v;
  const auto can = [&](double fast) {
    return is_rise ? glide_.plan(zones, {from.s, v}, {to.s, fast}, ramp_)
                   : glide_.plan(zones, {from.s, fast}, {to.s, v}, ramp_);
  };
  if (can(most)) {
    return most;
  }
  double low = v;
  double high = most;
  for (int i = 0; i < kPlannedHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (can(middle) ? low : high) = middle;
  }
  return low;
}

/// Lowers the passages from which the next one, or the end, could not be reached.
/// @returns whether one has become slow
bool PassageGlide::slow_down_backward(const Anchor& start, const Anchor& end) {
  for (std::size_t i = held_.size(); i > 0; --i) {
    const Anchor from = end_of(i, start);
    const Anchor to = begin_of(i, end);
    if (from.v <= to.v || held_[i - 1].is_start) {
      continue;
    }
    const double v = reach(to.v, from, to, from.v);
    Held& held = held_[i - 1];
    if (v < held.v * (1.0 - kFeedrateRounding)) {
      held.v = v;
      held.is_slowed = true;
      free_end_ = std::min(free_end_, zones_[held.zone].begin);
      if (v <= zones_[held.zone].held_above) {
        return make_slow(i - 1, true);
      }
    }
  }
  return false;
}

/// Lowers the passages that could not be reached from the one before, or from the start.
/// @returns whether one has become slow
bool PassageGlide::slow_down_forward(const Anchor& start, const Anchor& end) {
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const Anchor from = end_of(i, start);
    const Anchor to = begin_of(i, end);
    if (from.v >= to.v || held_[i].is_start) {
      continue;
    }
    const double v = reach(from.v, from, to, to.v);
    if (v < to.v * (1.0 - kFeedrateRounding)) {
      held_[i].v = v;
      if (v <= zones_[held_[i].zone].held_above) {
        return make_slow(i, false);
      }
    }
  }
  return false;
}

void PassageGlide::append_glide() {
  const std::size_t first = phases_.size();
  phases_.insert(phases_.end(), glide_.phases().begin(), glide_.phases().end());
  for (const Glide::Part& part : glide_.parts()) {
    parts_.push_back({part.first + first, part.descent + first});
  }
  leg_ends_.insert(leg_ends_.end(), glide_.leg_ends().begin(), glide_.leg_ends().end());
  is_even_ = is_even_ || glide_.is_even();
}

/// Plans between the passages. @returns false where there is no plan
bool PassageGlide::compose(const Anchor& start, const Anchor& end) {
  while (slow_down_backward(start, end) || slow_down_forward(start, end)) {
  }
  phases_.clear();
  parts_.clear();
  leg_ends_.clear();
  is_even_ = false;
  first_after_passage_ = 0;
  for (std::size_t i = 0; i <= held_.size(); ++i) {
    const Anchor from = end_of(i, start);
    const Anchor to = begin_of(i, end);
    const bool is_inside = i < held_.size() && held_[i].is_start;
    if (!is_inside && to.s > from.s + kPlaceRounding) {
      if (!glide_.plan(zones_between(from, to), from, to, ramp_)) {
        return false;
      }
      append_glide();
    }
    if (i < held_.size()) {
      const LimitZone& zone = zones_[held_[i].zone];
      const double begin = is_inside ? start.s : zone.begin;
      phases_.push_back({(zone.end - begin) / held_[i].v, begin, held_[i].v, 0.0, 0.0});
      leg_ends_.push_back(zone.end);
      if (zone.end <= free_end_ + kPlaceRounding) {
        first_after_passage_ = phases_.size();
      }
    }
  }
  return !parts_.empty();
}

}  // namespace twin::feedrate
