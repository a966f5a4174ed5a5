#include "feedrate/certified/dips.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {
namespace {

/// Limits of one valley, over the lowest of them. More lets a valley reach up its own sides, where a dip
/// gains nothing; less divides one that is uneven.
constexpr double kSameValley = 1.02;

/// Shortest time in a valley that gets a dip [s]. Half as much makes more zones, for gains of a tenth of a
/// millisecond.
constexpr double kLasting = 0.005;

/// Steps of T that are tried. Twice as many find some microseconds more.
constexpr int kSteps = 12;

/// A valley: zones [first, last).
struct Valley {
  std::size_t first;
  std::size_t last;
  double limit;   // V [mm/s]
  double before;  // F_1, that is reached before it [mm/s]
  double after;   // F_2 [mm/s]
};

/// Time lost by a rise from v to F, beside running at F [s].
double rise_loss(double v, double feedrate, const RampLimits& ramp) {
  return v < feedrate ? ramp_time(feedrate - v, ramp) - ramp_distance(v, feedrate, ramp) / feedrate
                      : 0.0;
}

/// Feedrate that is reached on a side of a valley: the first limit that a rise with J from V would meet,
/// which after a way s is at V + J s^2 / (2 V^2) at most; and no more than half of the way to the next place
/// that is as low allows.
/// @param step  1: after the valley, -1: before it
double reached_beside(const std::vector<LimitZone>& zones, std::size_t row, const Valley& valley,
                      std::ptrdiff_t step, double asked, const RampLimits& ramp) {
  double reached = asked;
  double way = 0.0;
  auto i = static_cast<std::ptrdiff_t>(step > 0 ? valley.last : valley.first - 1);
  for (; i >= static_cast<std::ptrdiff_t>(row) && i < std::ssize(zones); i += step) {
    const LimitZone& zone = zones[static_cast<std::size_t>(i)];
    if (zone.limit <= valley.limit * kSameValley) {
      return std::min(reached, std::max(ramp_reach(valley.limit, 0.5 * way, ramp), valley.limit));
    }
    way += zone.end - zone.begin;
    const double rise = way / valley.limit;
    if (zone.limit < valley.limit + 0.5 * ramp.jerk * rise * rise) {
      reached = std::min(reached, zone.limit);
    }
  }
  return reached;
}

/// Whether the limits on a side of a valley let a rise go on that leaves it at V with an acceleration a,
/// up to the feedrate that is reached there. After a way s it is at V + a s / V + J s^2 / (2 V^2) at most.
bool is_left_freely(const std::vector<LimitZone>& zones, std::size_t row, const Valley& valley,
                    std::ptrdiff_t step, double acceleration, double jerk) {
  const double reached = step > 0 ? valley.after : valley.before;
  double time = 0.0;
  auto i = static_cast<std::ptrdiff_t>(step > 0 ? valley.last : valley.first - 1);
  for (; i >= static_cast<std::ptrdiff_t>(row) && i < std::ssize(zones); i += step) {
    const LimitZone& zone = zones[static_cast<std::size_t>(i)];
    time += (zone.end - zone.begin) / valley.limit;
    const double v = valley.limit + time * (acceleration + 0.5 * jerk * time);
    if (zone.limit < std::min(v, reached)) {
      return false;
    }
    if (v >= reached) {
      return true;
    }
  }
  return true;
}

/// Time lost in and beside a valley that is passed along its limits [s].
double loss_along(const std::vector<LimitZone>& zones, const Valley& valley, double mean,
                  const RampLimits& ramp) {
  double loss = rise_loss(zones[valley.first].limit, valley.before, ramp) +
                rise_loss(zones[valley.last - 1].limit, valley.after, ramp);
  for (std::size_t i = valley.first; i < valley.last; ++i) {
    loss += (zones[i].end - zones[i].begin) * (1.0 / zones[i].limit - 1.0 / mean);
  }
  return loss;
}

/// Lowers the limits of a valley between two places; a zone that goes beyond them is divided.
void lower_between(double begin, double end, double limit, const Valley& valley,
                   std::vector<LimitZone>& zones) {
  std::vector<LimitZone> parts;
  for (std::size_t i = valley.first; i < valley.last; ++i) {
    LimitZone rest = zones[i];
    for (const double border : {begin, end}) {
      if (rest.begin < border && border < rest.end) {
        parts.push_back(rest);
        parts.back().end = rest.begin = border;
      }
    }
    parts.push_back(rest);
  }
  const auto is_within = [&](const LimitZone& zone) {
    return zone.begin >= begin && zone.end <= end;
  };
  const auto from = std::find_if(parts.begin(), parts.end(), is_within);
  if (from == parts.end()) {
    return;
  }
  const auto to = std::find_if_not(from, parts.end(), is_within);
  from->end = std::prev(to)->end;
  from->limit = limit;
  parts.erase(std::next(from), to);
  const auto place = zones.erase(zones.begin() + static_cast<std::ptrdiff_t>(valley.first),
                                 zones.begin() + static_cast<std::ptrdiff_t>(valley.last));
  zones.insert(place, parts.begin(), parts.end());
}

/// Lowers the limit in the middle of a valley, if that gains time.
void add_dip(const Valley& valley, std::size_t row, const RampLimits& ramp,
             std::vector<LimitZone>& zones) {
  const double jerk = ramp.jerk;
  const double begin = zones[valley.first].begin;
  const double end = zones[valley.last - 1].end;
  const double mean = 0.5 * (valley.before + valley.after);
  double least = loss_along(zones, valley, mean, ramp);
  double best = 0.0;  // T
  const double longest = std::min(std::sqrt(valley.limit / jerk), ramp.acceleration / jerk);
  const auto way_of = [&](double t) { return t * (valley.limit - jerk * t * t / 3.0); };
  const auto feedrate_of = [&](double t) { return valley.limit - 0.5 * jerk * t * t; };
  for (int i = 1; i <= kSteps; ++i) {
    const double t = longest * i / kSteps;
    const double rest = end - begin - 2.0 * way_of(t);
    if (rest <= 0.0 || !is_left_freely(zones, row, valley, -1, jerk * t, jerk) ||
        !is_left_freely(zones, row, valley, 1, jerk * t, jerk)) {
      break;
    }
    const double v = feedrate_of(t);
    const double loss = rise_loss(v, valley.before, ramp) + rise_loss(v, valley.after, ramp) +
                        rest * (1.0 / v - 1.0 / mean);
    if (loss < least) {
      least = loss;
      best = t;
    }
  }
  if (best > 0.0) {
    lower_between(begin + way_of(best), end - way_of(best), feedrate_of(best), valley, zones);
  }
}

}  // namespace

void add_dips(std::vector<LimitZone>& zones, std::size_t first, double asked,
              const RampLimits& ramp) {
  for (std::size_t i = zones.size(); i-- > first;) {
    if (zones[i].limit >= asked || (i > first && zones[i - 1].limit < zones[i].limit) ||
        (i + 1 < zones.size() && zones[i + 1].limit < zones[i].limit)) {
      continue;  // no lowest one
    }
    Valley valley{i, i + 1, zones[i].limit, asked, asked};
    const double most = kSameValley * valley.limit;
    for (; valley.first > first && zones[valley.first - 1].limit <= most; --valley.first) {
      valley.limit = std::min(valley.limit, zones[valley.first - 1].limit);
    }
    for (; valley.last < zones.size() && zones[valley.last].limit <= most; ++valley.last) {
      valley.limit = std::min(valley.limit, zones[valley.last].limit);
    }
    const bool is_inside = valley.first > first && valley.last < zones.size();
    const double width = zones[valley.last - 1].end - zones[valley.first].begin;
    if (is_inside && width >= kLasting * valley.limit) {
      valley.before = reached_beside(zones, first, valley, -1, asked, ramp);
      valley.after = reached_beside(zones, first, valley, 1, asked, ramp);
      if (std::min(valley.before, valley.after) > most) {
        add_dip(valley, first, ramp, zones);
      }
    }
    i = valley.first;
  }
}

}  // namespace twin::feedrate
