#include "feedrate/envelope.hpp"

#include <algorithm>
#include <limits>

namespace twin::feedrate {
namespace {

constexpr double kPlaceRounding = 1e-9;  // [mm]
constexpr double kSameFeedrate = 1e-9;   // relative

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
  zones_ = zones;
  humps_.clear();
  pending_.clear();
  if (!is_reachable(start, end, limits_)) {
    return false;
  }
  pending_.push_back({start, end, 0, zones.size(), std::numeric_limits<double>::infinity()});
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
  const auto zones = zones_.subspan(piece.first, piece.last - piece.first);
  const double cap = std::min(piece.cap, highest_limit(zones, piece.a.s, piece.b.s));
  const Hump hump = make_hump(piece.a, piece.b, cap, limits_);
  std::size_t worst = zones.size();
  Interval fast{};
  for (std::size_t i = 0; i < zones.size(); ++i) {
    const LimitZone& zone = zones[i];
    if (zone.limit >= hump.peak * (1.0 - kSameFeedrate) ||
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
  if (zone.limit < std::max(piece.a.v, piece.b.v) * (1.0 - kSameFeedrate)) {
    return false;
  }
  Piece lower = piece;
  lower.cap = zone.limit;
  pending_.push_back(lower);
  return true;
}

bool Envelope::split(const Piece& piece, std::size_t index, bool enters_fast, bool leaves_fast) {
  const LimitZone& zone = zones_[index];
  const Knot& a = piece.a;
  const Knot& b = piece.b;
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
  in.is_at_limit = in.v == zone.limit;
  out.is_at_limit = out.v == zone.limit;
  // Pieces are pushed last first, so that they are settled in path order.
  if (enters_fast && leaves_fast) {
    if (!is_reachable(a, in, limits_) || !is_reachable(out, b, limits_)) {
      return false;
    }
    pending_.push_back({out, b, index + 1, piece.last, piece.cap});
    if (!is_place) {
      pending_.push_back({in, out, index, index + 1, piece.cap});
    }
    pending_.push_back({a, in, piece.first, index, piece.cap});
    return true;
  }
  const Knot& knot = enters_fast ? in : out;
  const std::size_t border = enters_fast ? index : index + 1;
  if (!is_reachable(a, knot, limits_) || !is_reachable(knot, b, limits_)) {
    return false;
  }
  pending_.push_back({knot, b, border, piece.last, piece.cap});
  pending_.push_back({a, knot, piece.first, border, piece.cap});
  return true;
}

}  // namespace twin::feedrate
