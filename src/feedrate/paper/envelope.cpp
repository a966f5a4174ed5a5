#include "feedrate/paper/envelope.hpp"
#include "feedrate/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twin::feedrate {
namespace {

constexpr std::size_t kLowerings = 4;  // of limits by zone, after which there is no plan

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

bool Envelope::plan(std::span<const LimitZone> zones, const Knot& start, const Knot& end) {
  given_ = zones_ = zones;
  if (!is_reachable(start, end, limits_)) {
    return false;
  }
  for (std::size_t lowered = 0; lowered <= kLowerings * zones.size(); ++lowered) {
    is_lowered_ = false;
    if (settle_all(start, end)) {
      return true;
    }
    if (!is_lowered_) {
      return false;
    }
  }
  return false;
}

bool Envelope::settle_all(const Knot& start, const Knot& end) {
  humps_.clear();
  pending_.clear();
  pending_.push_back({{start}, {end}, 0, zones_.size(), std::numeric_limits<double>::infinity()});
  while (!pending_.empty()) {
    const Piece piece = pending_.back();
    pending_.pop_back();
    if (!settle(piece)) {
      return false;
    }
  }
  return true;
}

bool Envelope::settle(const Piece& piece) {
  const Knot& a = piece.a.knot;
  const Knot& b = piece.b.knot;
  const auto zones = zones_.subspan(piece.first, piece.last - piece.first);
  const double cap = std::min(piece.cap, highest_limit(zones, a.s, b.s));
  const Hump hump = make_hump(a, b, cap, limits_);
  std::size_t worst = zones.size();
  Interval fast{};
  for (std::size_t i = 0; i < zones.size(); ++i) {
    const LimitZone& zone = zones[i];
    if (zone.limit >= hump.peak * (1.0 - kFeedrateRounding) ||
        (worst < zones.size() && zone.limit >= zones[worst].limit)) {
      continue;
    }
    const Interval interval = faster_than(hump, zone.limit, limits_);
    if (zone.end > interval.begin + kPlaceRounding && zone.begin < interval.end - kPlaceRounding) {
      worst = i;
      fast = interval;
    }
  }
  if (worst == zones.size()) {
    humps_.push_back(hump);
    return true;
  }
  const LimitZone& zone = zones[worst];
  const bool enters_fast = is_inside(zone.begin, fast);
  const bool leaves_fast = is_inside(zone.end, fast);
  if ((enters_fast || leaves_fast) && split(piece, piece.first + worst, enters_fast, leaves_fast)) {
    return true;
  }
  if (zone.limit < std::max(a.v, b.v) * (1.0 - kFeedrateRounding)) {
    is_lowered_ = lower_knot(piece, zone);
    return false;
  }
  Piece lower = piece;
  lower.cap = zone.limit;
  pending_.push_back(lower);
  return true;
}

bool Envelope::lower_knot(const Piece& piece, const LimitZone& zone) {
  const bool is_a = piece.a.knot.v > piece.b.knot.v;
  const auto& [fast, owner] = is_a ? piece.a : piece.b;
  const Knot& slow = is_a ? piece.b.knot : piece.a.knot;
  if (owner == kNone) {
    return false;
  }
  // From the slower knot to the zone's far side, and from there to the place of the faster one.
  const double side = is_a ? zone.begin : zone.end;
  const double between = std::min(zone.limit, ramp_reach(slow.v, std::abs(side - slow.s), limits_));
  const double reached = ramp_reach(between, std::abs(fast.s - side), limits_);
  if (zones_.data() != lowered_.data()) {
    lowered_.assign(zones_.begin(), zones_.end());
    zones_ = lowered_;
  }
  double& limit = lowered_[owner].limit;
  limit = std::min(limit, reached < fast.v ? reached : zone.limit);
  return true;
}

bool Envelope::split(const Piece& piece, std::size_t index, bool enters_fast, bool leaves_fast) {
  const LimitZone& zone = zones_[index];
  const Knot& a = piece.a.knot;
  const Knot& b = piece.b.knot;
  Knot in{zone.begin, std::min(zone.limit, ramp_reach(a.v, zone.begin - a.s, limits_))};
  Knot out{zone.end, std::min(zone.limit, ramp_reach(b.v, b.s - zone.end, limits_))};
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
  // Pieces are pushed last first, so that they are settled in path order.
  if (enters_fast && leaves_fast) {
    if (!is_reachable(a, in, limits_) || !is_reachable(out, b, limits_)) {
      return false;
    }
    pending_.push_back({{out, index}, piece.b, index + 1, piece.last, piece.cap});
    if (!is_place) {
      pending_.push_back({{in, index}, {out, index}, index, index + 1, piece.cap});
    }
    pending_.push_back({piece.a, {in, index}, piece.first, index, piece.cap});
    return true;
  }
  const PieceEnd end{enters_fast ? in : out, index};
  const std::size_t border = enters_fast ? index : index + 1;
  if (!is_reachable(a, end.knot, limits_) || !is_reachable(end.knot, b, limits_)) {
    return false;
  }
  pending_.push_back({end, piece.b, border, piece.last, piece.cap});
  pending_.push_back({piece.a, end, piece.first, border, piece.cap});
  return true;
}

}  // namespace twin::feedrate
