#include "feedrate/limits/corners.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

/// Share of J_max that a hidden corner may seem to be. It trades feedrate at such corners for jerk
/// that the set points seem to have: twice as much allows twice the feedrate.
constexpr double kRipple = 0.1;

double turn_between(const Vec3& before, const Vec3& after) {
  return std::atan2(before.cross(after).norm(), before.dot(after));
}

/// Share of an axis's acceleration and jerk that a jump may use. The rest is for the motion beside
/// it, which has the same periods: twice as much makes jumps faster by its square root, and the set
/// points beside them may exceed the limits.
constexpr double kJumpShare = 0.25;

/// Share of an axis's jerk for the tangential motion beside a jump.
constexpr double kBesideJump = 0.5;

constexpr double kNoJump = 1e-9;  // of dC/ds [-] and of d2C/ds2 [1/mm]

/// How much more than at its begin the feedrate is on average over the first period of a ramp: the
/// jerk is J until A is reached [mm/s].
double mean_rise(const RampLimits& ramp, double period) {
  if (ramp.jerk * period <= ramp.acceleration) {
    return ramp.jerk * period * period / 6.0;
  }
  const double t = ramp.acceleration / ramp.jerk;
  const double hold = period - t;
  return ramp.acceleration * (t * t / 6.0 + 0.5 * t * hold + 0.5 * hold * hold) / period;
}

/// Corner feedrate of the acceleration rule. The feedrate is lowest at the corner itself and
/// averages mean_rise() more over the periods on either side, where the set points see it. Beside a
/// bend it does not rise as much, so some of it is left.
double passing_feedrate(double turn, double curvature, const RampLimits& ramp, double period) {
  const double corner = corner_acceleration_feedrate(turn, curvature, ramp.acceleration, period);
  const double left = 0.5 * std::min(1.0, ramp.acceleration / (ramp.jerk * period));
  return std::max(corner - mean_rise(ramp, period), left * corner);
}

}  // namespace

double corner_model_feedrate(double turn, double corner_error,
                             const PlanningModel& model) noexcept {
  const double c = std::sin(0.5 * turn);  // cos(theta / 2)
  return c > 0.0 ? model.kp / (1.0 - model.kf) * corner_error / c
                 : std::numeric_limits<double>::infinity();
}

double corner_acceleration_feedrate(double turn, double curvature, double acceleration,
                                    double period) noexcept {
  const double c = 2.0 * std::sin(0.5 * turn);
  const double k = curvature * period;
  const double at = acceleration * period;
  const double root = c + std::sqrt(c * c + 4.0 * k * at);  // 2 A T / v
  return root > 0.0 ? 2.0 * at / root : std::numeric_limits<double>::infinity();
}

double corner_ripple_feedrate(double turn, double jerk, double period) noexcept {
  return turn > 0.0 ? 2.0 * kRipple * jerk * period * period / (turn * turn)
                    : std::numeric_limits<double>::infinity();
}

LimitZone axis_jump_limit(const path::PathPoint& before, const path::PathPoint& after,
                          const Limits& limits, double period) noexcept {
  LimitZone zone;
  zone.limit = std::numeric_limits<double>::infinity();
  const Vec3 turn = (after.tangent - before.tangent).cwiseAbs();
  const Vec3 bend = (after.curvature - before.curvature).cwiseAbs();
  for (int i = 0; i < 3; ++i) {
    const double a = kJumpShare * limits.axis_acceleration[i];
    const double j = kJumpShare * limits.axis_jerk[i];
    if (a > 0.0 && turn[i] > kNoJump) {
      zone.limit = std::min(zone.limit, a * period / turn[i]);
    }
    if (j > 0.0 && turn[i] > kNoJump) {
      zone.limit = std::min(zone.limit, j * period * period / turn[i]);
    }
    if (j > 0.0 && bend[i] > kNoJump) {
      zone.limit = std::min(zone.limit, std::sqrt(j * period / bend[i]));
      const double along = std::max(std::abs(before.tangent[i]), std::abs(after.tangent[i]));
      zone.jerk = std::min(zone.jerk, kBesideJump * limits.axis_jerk[i] / std::max(along, 1e-3));
    }
  }
  if (limits.jerk_of == JerkOf::kVector) {
    const double j = kJumpShare * limits.jerk;
    if (turn.norm() > kNoJump) {
      zone.limit = std::min(zone.limit, j * period * period / turn.norm());
    }
    if (bend.norm() > kNoJump) {
      zone.limit = std::min(zone.limit, std::sqrt(j * period / bend.norm()));
      zone.jerk = std::min(zone.jerk, kBesideJump * limits.jerk);
    }
  }
  return zone;
}

JunctionLimits::JunctionLimits(const Limits& limits, const PlanningModel& model, double period)
    : limits_(limits),
      model_(model),
      ramp_{limits.acceleration, limits.jerk},
      period_(period),
      turn_back_(corner_ripple_feedrate(std::numbers::pi, limits.jerk, period)) {}

void JunctionLimits::append(const path::Segment& before, const path::Segment& after, double s,
                            std::vector<LimitZone>& zones) {
  if (before.stops_at_end || after.length == 0.0) {
    zones.push_back({s, s, 0.0});
    turns_.clear();
    return;
  }
  LimitZone place = axis_jump_limit(before.end, after.begin, limits_, period_);
  place.begin = place.end = s;
  const double turn = turn_between(before.end.tangent, after.begin.tangent);
  if (turn < kNoTurn) {
    if (place.limit < limits_.feedrate) {
      zones.push_back(place);
    }
    return;
  }
  const double reach = limits_.feedrate * period_;
  const double curvature = std::max(curvature_near(SegmentEnd::kEnd, before, reach),
                                    curvature_near(SegmentEnd::kBegin, after, reach));
  const double corner_error = std::min(before.corner_error, after.corner_error);
  double limit = std::min(corner_model_feedrate(turn, corner_error, model_),
                          passing_feedrate(turn, curvature, ramp_, period_));
  if (turn < kSharpTurn && curvature > 0.0) {
    limit = std::min(limit, std::max(kHidingShare * turn / (curvature * period_),
                                     corner_ripple_feedrate(turn, limits_.jerk, period_)));
  }
  place.limit = std::min(place.limit, limit);
  zones.push_back(place);
  limit_cluster(turn, s, zones);
}

/// Limits corners a few periods apart by each other. Where the turns of several corners, over the
/// distance l from the first to the last, sum to phi, either the feedrate keeps them apart
/// (v T <= l), or it obeys the corner rule for phi. Where one corner hides another from the set
/// points, either the feedrate puts kHidingPeriods between them, or it keeps the ripple small. Two
/// sharp corners hide each other: a period that holds both, there and back, seems to go straight on.
void JunctionLimits::limit_cluster(double turn, double s, std::vector<LimitZone>& zones) {
  LimitZone& latest = zones.back();
  const auto lower = [](LimitZone& zone, double limit) {
    zone.limit = std::min(zone.limit, limit);
  };
  double sum = turn;
  for (std::size_t i = turns_.size(); i-- > 0;) {
    const Turn& old = turns_[i];
    const double apart = (s - old.s) / period_;
    if (apart >= kHidingPeriods * latest.limit) {
      break;
    }
    sum += old.angle;
    LimitZone& zone = zones[old.zone];
    const double together = passing_feedrate(std::min(sum, std::numbers::pi), 0.0, ramp_, period_);
    lower(latest, std::max(apart, together));
    lower(zone, std::max(apart, together));
    const auto limit_hidden = [&](double hidden, double hiding, LimitZone& place) {
      if (hidden < kSharpTurn && hiding > kHidingShare * hidden) {
        lower(place, std::max(apart / kHidingPeriods,
                              corner_ripple_feedrate(hidden, limits_.jerk, period_)));
      }
    };
    if (turn >= kSharpTurn && old.angle >= kSharpTurn) {
      const double seen = std::max(apart / kHidingPeriods, turn_back_);
      lower(latest, seen);
      lower(zone, seen);
    }
    limit_hidden(turn, old.angle, latest);
    limit_hidden(old.angle, turn, zone);
  }
  const double forget = s - kHidingPeriods * limits_.feedrate * period_;
  std::erase_if(turns_, [&](const Turn& past) { return past.s < forget; });
  turns_.push_back({s, turn, zones.size() - 1});
}

void JunctionLimits::forget(double distance, std::size_t zones) {
  std::erase_if(turns_, [&](const Turn& turn) { return turn.zone < zones; });
  for (Turn& turn : turns_) {
    turn.s -= distance;
    turn.zone -= zones;
  }
}

}  // namespace twin::feedrate
