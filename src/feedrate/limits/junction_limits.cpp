#include "feedrate/limits/junction_limits.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "feedrate/limits/corner_limit.hpp"
#include "feedrate/limits/segment_limits.hpp"

namespace twin::feedrate {
namespace {

constexpr double kNoTurn = 1e-7;  // turn that is none [rad]

double turn_between(const Vec3& before, const Vec3& after) {
  return std::atan2(before.cross(after).norm(), before.dot(after));
}

/// Corner feedrate of the acceleration rule. The feedrate is lowest at the corner itself and
/// averages J T^2 / 6 more over the periods on either side, where the set points see it.
double passing_feedrate(double turn, double curvature, const RampLimits& ramp, double period) {
  const double corner = corner_acceleration_feedrate(turn, curvature, ramp.acceleration, period);
  return std::max(corner - ramp.jerk * period * period / 6.0, 0.5 * corner);
}

}  // namespace

JunctionLimits::JunctionLimits(const Limits& limits, const PlanningModel& model, double period)
    : limits_(limits), model_(model), ramp_{limits.acceleration, limits.jerk}, period_(period) {}

void JunctionLimits::append(const path::Segment& before, const path::Segment& after, double s,
                            std::vector<LimitZone>& zones) {
  if (before.stops_at_end || after.length == 0.0) {
    zones.push_back({s, s, 0.0});
    turns_.clear();
    return;
  }
  const double turn = turn_between(before.end.tangent, after.begin.tangent);
  if (turn < kNoTurn) {
    return;
  }
  const double reach = limits_.feedrate * period_;
  const double curvature =
      std::max(curvature_near_end(before, true, reach), curvature_near_end(after, false, reach));
  const double corner_error = std::min(before.corner_error, after.corner_error);
  double limit = std::min(corner_model_feedrate(turn, corner_error, model_),
                          passing_feedrate(turn, curvature, ramp_, period_));
  if (turn < kSharpTurn && curvature > 0.0) {
    limit = std::min(limit, std::max(kHidingShare * turn / (curvature * period_),
                                     corner_ripple_feedrate(turn, limits_.jerk, period_)));
  }
  zones.push_back({s, s, limit});
  limit_cluster(turn, s, zones);
}

/// Corners a few periods apart limit each other. Where the turns of several corners, over the
/// distance l from the first to the last, sum to phi, the feedrate either keeps them apart (v T <=
/// l) or obeys the corner rule for phi. And where one hides the other from the set points, it
/// either puts kHidingPeriods between them or keeps the ripple small.
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
