#include "feedrate/certified/corner_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "feedrate/certified/summit.hpp"

namespace twin::feedrate {
namespace {

/// Ratio of the distances from the corner at which the parts of a bump end. Larger parts have the limits of
/// their slow ends all along, and make the bump seem slower; smaller ones take more time.
constexpr double kPartStep = 1.15;

/// The first part of a bump, over the share of its half width within which the pace |C'| doubles, and
/// the least share. Where the path nearly turns back, the feedrate rises steeply from the middle on.
constexpr double kFirstPart = 0.25;
constexpr double kLeastPart = 1.0 / 128.0;

/// A stop has to be quicker by so much. It is what the times leave open: legs whose ends are not alike, and
/// zones that are merged. With less, corners stay sharp that are slower for it.
constexpr double kClearly = 0.98;

/// Acceleration and jerk of a zone.
RampLimits ramp_of(const LimitZone& zone, const RampLimits& most) {
  return {std::min({zone.acceleration, zone.deceleration, most.acceleration}),
          std::min(zone.jerk, most.jerk), most.profile};
}

/// Time of a way from a feedrate to the highest that can be had at its end, both without acceleration [s].
double rise_time(double from, double way, double limit, const RampLimits& ramp) {
  if (from >= limit) {
    return way / from;
  }
  const double to = std::min(limit, ramp_reach(from, way, ramp));
  return ramp_time(to - from, ramp) + std::max(way - ramp_distance(from, to, ramp), 0.0) / to;
}

/// Lowest limit of zones [mm/s].
double lowest(const std::vector<LimitZone>& zones) {
  double limit = std::numeric_limits<double>::infinity();
  for (const LimitZone& zone : zones) {
    limit = std::min(limit, zone.limit);
  }
  return limit;
}

}  // namespace

/// Makes the zones of both sides. @param first  share of the half width with the first limit
void CornerTimes::divide(const path::RoundedCorner& corner, double first) {
  const Vec3 turn = corner.after.at.tangent - corner.before.at.tangent;
  const double angle = 2.0 * std::asin(std::min(0.5 * turn.norm(), 1.0));
  shares_.clear();
  for (double share = first; share < 1.0; share *= kPartStep) {
    shares_.push_back(share);
  }
  const auto start = [&](Side& side, const path::CornerSide& leg, Sense sense) {
    side.zones.clear();
    side.sense = sense;
    side.bump = 0.0;
    side.rest = std::max(0.5 * leg.length - corner.half_width, 0.0);
    side.leg = limits_->zone_from(leg.at, 0.0, 0.5 * leg.length, leg.feedrate);
  };
  start(before_, corner.before, Sense::kBackward);
  start(after_, corner.after, Sense::kForward);
  const auto append_leg = [](Side& side, double s) {
    side.zones.push_back(side.leg);
    side.zones.back().begin = s;
    side.zones.back().end = s + side.rest;
  };
  append_leg(before_, 0.0);
  for (const geometry::SpanCubic& piece : corner.pieces) {
    const bool is_before = 0.5 * (piece.begin + piece.end) < corner.corner;
    Side& side = is_before ? before_ : after_;
    const double feedrate = is_before ? corner.before.feedrate : corner.after.feedrate;
    const auto append = [&](double from, double to) {
      if (to > from) {
        const double s = side.zones.empty() ? 0.0 : side.zones.back().end;
        side.zones.push_back(limits_->zone_of(piece, from, to, s, feedrate, angle));
        side.bump += side.zones.back().end - side.zones.back().begin;
      }
    };
    double from = piece.begin;
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      const double border =
          is_before ? corner.corner - corner.half_width * shares_[shares_.size() - 1 - i]
                    : corner.corner + corner.half_width * shares_[i];
      if (border > from && border < piece.end) {
        append(from, border);
        from = border;
      }
    }
    append(from, piece.end);
  }
  append_leg(after_, after_.zones.empty() ? 0.0 : after_.zones.back().end);
}

/// Time of a side through the bump, from a feedrate in its middle [s].
double CornerTimes::time_of(const Side& side, double from) {
  const bool is_up = side.sense == Sense::kForward;
  const Anchor anchor{is_up ? 0.0 : side.zones.back().end, from};
  const double ceiling = std::max(side.leg.limit, from);
  for (ZoneAscent* rise : {&up_, &down_}) {
    rise->start(side.zones, is_up ? 0 : side.zones.size() - 1, anchor, side.sense, ramp_, ceiling);
  }
  const auto summit = join(up_, down_, 2.0 * (side.bump + side.rest), from, ceiling);
  if (!summit) {
    return (side.bump + side.rest) / from;
  }
  phases_.clear();
  append_phases(*summit, up_, down_, 0.0, phases_);
  double time = 0.0;
  for (const Phase& phase : phases_) {
    time += phase.duration;
  }
  return 0.5 * time;
}

bool CornerTimes::is_stop_quicker(const path::RoundedCorner& corner) {
  divide(corner, 1.0);
  const auto with_stop = [&](const Side& side) {
    return rise_time(0.0, side.leg.end - side.leg.begin, side.leg.limit, ramp_of(side.leg, ramp_));
  };
  const double stop = with_stop(before_) + with_stop(after_);
  double middle = std::min(lowest(before_.zones), lowest(after_.zones));
  const auto at_most = [&](const Side& side) {
    return side.bump / middle +
           rise_time(middle, side.rest, side.leg.limit, ramp_of(side.leg, ramp_));
  };
  if (at_most(before_) + at_most(after_) <= stop) {
    return false;
  }
  const double pace = 0.5 * (corner.before.at.tangent + corner.after.at.tangent).norm();
  divide(corner, std::max(kFirstPart * pace, kLeastPart));
  middle = std::min(lowest(before_.zones), lowest(after_.zones));
  return stop < kClearly * (time_of(before_, middle) + time_of(after_, middle));
}

}  // namespace twin::feedrate
