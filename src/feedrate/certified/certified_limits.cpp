#include "feedrate/certified/certified_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "feedrate/certified/dips.hpp"
#include "feedrate/certified/path_derivatives.hpp"
#include "feedrate/limits/axis_limits.hpp"
#include "path/passage.hpp"

namespace twin::feedrate {

namespace {

/// Periods in which zones are passed that become one, where axes have limits of their own: their rises
/// cost more a zone. Corners of a nanometre would have thousands of zones otherwise; twice as much
/// would begin to be felt at corners of 10 um.
constexpr double kBriefZone = 0.2;

/// Ratio of limits that share a zone, where axes have no limits of their own. It trades time for work:
/// where the feedrate follows the limits, half of the difference is lost on average, and with twice
/// the difference about half as many zones are planned.
constexpr double kSameLimit = 1.001;

/// Curvatures of a brief bend that share a zone where nothing reaches their limits. More makes fewer zones,
/// and costs more where the bend is passed with acceleration after all.
constexpr double kSameBend = 1.7;

/// Parts of an arc, where axes have limits of their own: the share of each axis in the motion
/// changes along it. With twice as many, half as much is lost by taking the worst of each part.
constexpr int kArcParts = 48;

/// Share of an axis's acceleration and jerk that counts as left to the motion along the path where
/// a start that is too fast comes down. The feedrate may use 3/4 of the acceleration and 1/2 of the
/// jerk (axis_limits.hpp), so twice as much could be too much, and the way down too short.
constexpr double kRest = 0.25;

/// Largest turn of the path within a period in a bend that winds on (BendInterval::is_winding) [rad].
/// Set points that are farther apart do not tell the motion between them: the arc seems longer or
/// shorter by up to the fifth power of the turn. Only details of some 10 um have such bends; twice
/// as much leaves a jerk in their set points that nobody planned.
constexpr double kWindingTurn = 0.4;

/// Feedrate of a turn back, as a share of A T: it changes the velocity by 2 v. Without this floor,
/// bends of a hundredth of a micrometre would all but stop the motion.
constexpr double kAnyTurn = 0.25;

/// Share of A by which the acceleration changes in a period, J T / A, from which it swings, and the share at which
/// all of it does: from -A to A. Below, the part of the tangential acceleration that is square to the path is
/// small. Between them it grows with J, without a step: bends would lose more feedrate there than the ramps
/// beside them gain, and a higher jerk would be slower.
constexpr double kSwing = 0.25;
constexpr double kWholeSwing = 2.0;

/// Ratios of the accelerations and of the jerks that are told apart where they change along a curve.
/// Larger steps leave less of them, smaller ones make more places where they change.
constexpr double kAccelerationStep = 1.25;
constexpr double kJerkStep = 1.06;

/// The highest step that is not above a value, counted from the value on a line.
double on_step(double value, double most, double step) {
  if (!(value < most)) {
    return most;
  }
  return most * std::pow(step, -std::ceil(std::log(most / value) / std::log(step) - 1e-9));
}

/// Lowers acceleration and jerk of a zone to steps, so that they change in few places.
void put_on_steps(const RampLimits& most, LimitZone& zone) {
  zone.acceleration = on_step(zone.acceleration, most.acceleration, kAccelerationStep);
  zone.deceleration = on_step(zone.deceleration, most.acceleration, kAccelerationStep);
  zone.jerk = on_step(zone.jerk, most.jerk, kJerkStep);
}

/// Feedrate at which the normal acceleration leaves room for a share q of the tangential one that swings within
/// a period. With it the direction turns by kappa v T, and so much of q A is square to the path:
///   kappa v^2 + kappa v T q A = A.
double swinging_feedrate(double curvature, double acceleration, double period, double share) {
  const double b = curvature * period * share * acceleration;
  return 2.0 * acceleration / (b + std::sqrt(b * b + 4.0 * curvature * acceleration));
}

PlanningModel with_circular_error(PlanningModel model, double error) {
  model.circular_error = std::max(model.circular_error, error);
  return model;
}

/// The jerk as a limit of the first component.
Limits vector_limits_of(const Limits& limits) {
  Limits vector = limits;
  vector.axis_feedrate = vector.axis_acceleration = vector.axis_jerk = Vec3::Zero();
  vector.axis_jerk[0] = limits.jerk;
  return vector;
}

}  // namespace

CertifiedLimits::CertifiedLimits(const Limits& limits, const PlanningModel& model,
                                 const PathSettings& path, double period)
    : limits_(limits),
      ramp_{limits.acceleration, limits.jerk, model.acceleration_profile},
      lasting_(limits, model, path, period),
      brief_(limits, with_circular_error(model, model.corner_error), path, period),
      chord_error_(path.chord_error),
      period_(period),
      has_axis_limits_(has_axis_limits(limits)),
      has_vector_limits_(limits.jerk_of == JerkOf::kVector),
      vector_limits_(vector_limits_of(limits)),
      bends_(model.corner_error) {}

/// Feedrate at which any turn at all may lie within a period: it changes the velocity by less than
/// A and J allow [mm/s].
double CertifiedLimits::any_turn_feedrate() const noexcept {
  return kAnyTurn * period_ * std::min(limits_.acceleration, limits_.jerk * period_);
}

/// Share of the acceleration that swings within a period.
double CertifiedLimits::swinging_share() const noexcept {
  const double change = limits_.jerk * period_ / limits_.acceleration;
  return std::clamp((change - kSwing) / (kWholeSwing - kSwing), 0.0, 1.0);
}

double CertifiedLimits::limit_at(const BendInterval& interval, double feedrate, On what) const {
  const LocalGeometry at{interval.curvature};
  const double by_rule = interval.is_brief ? brief_.limit_at(at, feedrate, what)
                                           : lasting_.limit_at(at, feedrate, what);
  double limit = std::min(by_rule, chord_error_feedrate(at.curvature, chord_error_, period_));
  if (at.curvature > 0.0) {
    limit = std::min(limit, std::sqrt(limits_.acceleration / at.curvature));
    if (const double share = swinging_share(); share > 0.0) {
      limit = std::min(
          limit, std::max(swinging_feedrate(at.curvature, limits_.acceleration, period_, share),
                          any_turn_feedrate()));
    }
    if (interval.is_winding) {
      limit =
          std::min(limit, std::max(kWindingTurn / (at.curvature * period_), any_turn_feedrate()));
    }
  }
  return limit;
}

/// Limit of the middle of a brief bend [mm/s].
/// @param bend     the zone beside it
/// @param tangent  dC/ds in the middle
double CertifiedLimits::dip_limit(const BendPeak& peak, const LimitZone& bend, double feedrate,
                                  const Vec3& tangent) const {
  double jerk = limits_.jerk;
  for (int i = 0; i < 3; ++i) {
    if (limits_.axis_jerk[i] > 0.0 && tangent[i] != 0.0) {
      jerk = std::min(jerk, limits_.axis_jerk[i] / std::abs(tangent[i]));
    }
  }
  const double reached =
      std::isfinite(peak.room) ? path::feedrate_within(peak.room, feedrate, jerk) : feedrate;
  const path::Bump bump{peak.half, bend.limit, std::min(bend.jerk, jerk)};
  return bend.limit * path::best_passage(bump, reached, jerk).dip;
}

/// Lowers the limits of a zone to what the axes allow, and the jerk as a vector.
void CertifiedLimits::keep_derivatives(const ByArcLength& begin, const ByArcLength& middle,
                                       const ByArcLength& end, BendKind bend,
                                       LimitZone& zone) const {
  const double length = zone.end - zone.begin;
  if (has_axis_limits_) {
    keep_axis_limits(bounds_between(begin, middle, end, length), limits_, bend, zone);
  }
  if (has_vector_limits_) {
    keep_axis_limits(vector_bounds_between(begin, middle, end, length), vector_limits_, bend, zone);
  }
  if (has_axis_limits_ && has_vector_limits_) {
    zone.most = 0.0;  // what is left below the limit is known of each of them, not of both
  }
}

/// Lowers the limits of an interval of a curve to what the axes allow.
void CertifiedLimits::keep_axes(const path::FittedCurve& curve, const BendInterval& interval,
                                LimitZone& zone) const {
  const double u0 = interval.u0;
  const double u1 = interval.u1;
  const int span = curve.curve.find_span(0.5 * (u0 + u1));
  const auto from = curve.curve.derivatives(u0, span);
  const auto to = curve.curve.derivatives(u1, span);
  const auto middle = curve.curve.derivatives(0.5 * (u0 + u1), span);
  const Vec3 third = (to.second - from.second) / (u1 - u0);
  keep_derivatives(by_arc_length(from, third), by_arc_length(middle, third),
                   by_arc_length(to, third),
                   interval.is_brief ? BendKind::kBrief : BendKind::kLasting, zone);
  put_on_steps(ramp_, zone);
}

/// Appends the zones of a brief bend, from its middle to both ends as few as are felt: beside the middle,
/// where the limit is V, no feedrate is above V + J d^2 / (2 V^2) at the distance d, since it takes no longer
/// than d / V to get there, from no acceleration. Limits that are higher are not told apart.
void CertifiedLimits::append_brief_bend(const BendPeak& peak, double s0, double feedrate,
                                        ZoneRow& row) {
  const BendInterval& middle = bends_.intervals()[peak.interval];
  const double valley = limit_at(middle, feedrate, On::kCurve);
  const double rise = 0.5 * limits_.jerk / (valley * valley);
  beside_.clear();
  const auto add = [&](std::size_t first, const BendInterval& interval, double way) {
    if (beside_.size() > first) {
      Beside& last = beside_.back();
      if (interval.curvature <= last.curvature &&
          kSameBend * interval.curvature >= last.curvature &&
          last.limit - valley >= rise * way * way) {
        last.begin = std::min(last.begin, interval.begin);
        last.end = std::max(last.end, interval.end);
        return;
      }
    }
    beside_.push_back({interval.begin, interval.end, interval.curvature,
                       limit_at(interval, feedrate, On::kCurve)});
  };
  const auto append = [&](double begin, double end, double limit) {
    row.append({s0 + begin, s0 + end, limit});
  };
  for (std::size_t i = peak.interval; i-- > peak.first;) {
    const BendInterval& interval = bends_.intervals()[i];
    add(0, interval, middle.begin - interval.begin);
  }
  const std::size_t before = beside_.size();
  for (std::size_t i = before; i-- > 0;) {
    append(beside_[i].begin, beside_[i].end, beside_[i].limit);
  }
  append(middle.begin, middle.end, valley);
  for (std::size_t i = peak.interval + 1; i < peak.last; ++i) {
    const BendInterval& interval = bends_.intervals()[i];
    add(before, interval, interval.end - middle.end);
  }
  for (std::size_t i = before; i < beside_.size(); ++i) {
    append(beside_[i].begin, beside_[i].end, beside_[i].limit);
  }
}

void CertifiedLimits::append_curve(const path::FittedCurve& curve, double s0, double feedrate,
                                   std::vector<LimitZone>& zones) {
  bends_.find(curve);
  const bool has_dips = has_vector_limits_ || (limits_.axis_jerk.array() > 0.0).any();
  const bool has_ramps = has_axis_limits_ || has_vector_limits_;
  const std::size_t first = zones.size();
  ZoneRow row(zones, has_ramps ? ZoneMerging{.brief = kBriefZone * period_}
                               : ZoneMerging{.same = kSameLimit});
  auto peak = bends_.peaks().begin();
  for (std::size_t i = 0; i < bends_.intervals().size(); ++i) {
    if (!has_ramps && peak != bends_.peaks().end() && peak->first == i) {
      append_brief_bend(*peak, s0, feedrate, row);
      i = peak->last - 1;
      ++peak;
      continue;
    }
    const BendInterval& interval = bends_.intervals()[i];
    LimitZone zone{s0 + interval.begin, s0 + interval.end,
                   limit_at(interval, feedrate, On::kCurve)};
    if (has_ramps) {
      keep_axes(curve, interval, zone);
    }
    if (has_dips && peak != bends_.peaks().end() && peak->interval == i) {
      const double dip = dip_limit(*peak, zone, feedrate,
                                   path::point_from(curve.curve.derivatives(interval.u0)).tangent);
      if (dip < zone.limit && !row.is_empty()) {
        row.append({zone.begin, zone.begin, dip});
      }
      ++peak;
    }
    row.append(zone);
  }
  if (!has_ramps) {
    add_dips(zones, first, feedrate, ramp_);
  }
}

void CertifiedLimits::append_arc(const path::Segment& segment, double s0, double feedrate,
                                 std::vector<LimitZone>& zones) const {
  const auto* arc = std::get_if<path::Arc>(&segment.geometry);
  const BendInterval whole{0.0, segment.length, 0.0, 1.0,
                           std::max(segment.begin.curvature.norm(), segment.end.curvature.norm())};
  const double limit = limit_at(whole, feedrate, On::kArcOrLine);
  const int parts = arc != nullptr && has_axis_limits_ ? kArcParts : 1;
  ZoneRow row(zones);
  for (int i = 0; i < parts; ++i) {
    const double begin = segment.length * i / parts;
    const double end = i + 1 == parts ? segment.length : segment.length * (i + 1) / parts;
    LimitZone zone{s0 + begin, s0 + end, limit};
    if ((has_axis_limits_ || has_vector_limits_) && segment.length > 0.0) {
      const auto at = [&](double s) -> ByArcLength {
        const path::PathPoint p = arc != nullptr ? path::point_at(*arc, s) : segment.begin;
        return {p.tangent, p.curvature,
                arc != nullptr ? arc_twist(arc->geometry, p) : Vec3::Zero()};
      };
      keep_derivatives(at(begin), at(0.5 * (begin + end)), at(end), BendKind::kLasting, zone);
      if (parts > 1) {
        put_on_steps(ramp_, zone);
      }
    }
    row.append(zone);
  }
}

LimitZone CertifiedLimits::zone_of(const geometry::SpanCubic& piece, double u0, double u1,
                                   double s0, double feedrate, double turn) const {
  const auto derivatives_at = [&](double u) {
    const double t = u - piece.begin;
    return geometry::Derivatives{
        piece.position(u), piece.c1 + t * (2.0 * piece.c2 + 3.0 * t * piece.c3), piece.second(u)};
  };
  const bool is_brief = turn < kMostBriefTurn;
  const Vec3 third = 6.0 * piece.c3;
  const auto from = derivatives_at(u0);
  const auto middle = derivatives_at(0.5 * (u0 + u1));
  const auto to = derivatives_at(u1);
  const ByArcLength begin = by_arc_length(from, third);
  const ByArcLength end = by_arc_length(to, third);
  const double curvature_begin = begin.second.norm();
  const double curvature_end = end.second.norm();
  const double length =  // Simpson's rule
      (u1 - u0) / 6.0 * (from.first.norm() + 4.0 * middle.first.norm() + to.first.norm());
  const BendInterval interval{.begin = 0.0,
                              .end = length,
                              .u0 = u0,
                              .u1 = u1,
                              .curvature = std::max(curvature_begin, curvature_end),
                              .turn = 0.5 * length * (curvature_begin + curvature_end),
                              .is_brief = is_brief};
  LimitZone zone{s0, s0 + length, limit_at(interval, feedrate, On::kCurve)};
  if (has_axis_limits_ || has_vector_limits_) {
    keep_derivatives(begin, by_arc_length(middle, third), end,
                     is_brief ? BendKind::kBrief : BendKind::kLasting, zone);
  }
  return zone;
}

LimitZone CertifiedLimits::zone_from(const path::PathPoint& at, double s0, double length,
                                     double feedrate) const {
  const BendInterval interval{0.0, length, 0.0, 1.0, at.curvature.norm()};
  const ByArcLength place{at.tangent, at.curvature, Vec3::Zero()};
  LimitZone zone{s0, s0 + length, limit_at(interval, feedrate, On::kArcOrLine)};
  keep_derivatives(place, place, place, BendKind::kLasting, zone);
  return zone;
}

void CertifiedLimits::merge(std::vector<LimitZone>& zones, std::size_t first) const {
  LimitZone& before = zones[first - 1];
  const LimitZone& zone = zones[first];
  if (before.end > before.begin && zone.end > zone.begin && before.end == zone.begin &&
      !is_passage(before) && !is_passage(zone) && before.limit == zone.limit &&
      has_same_ramp(before, zone)) {
    before.end = zone.end;
    zones.erase(zones.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

RampLimits CertifiedLimits::least_ramp() const {
  RampLimits least = ramp_;
  if (has_vector_limits_) {
    least.jerk *= kRest;
  }
  for (int i = 0; i < 3; ++i) {
    if (limits_.axis_acceleration[i] > 0.0) {
      least.acceleration = std::min(least.acceleration, kRest * limits_.axis_acceleration[i]);
    }
    if (limits_.axis_jerk[i] > 0.0) {
      least.jerk = std::min(least.jerk, kRest * limits_.axis_jerk[i]);
    }
  }
  return least;
}

void CertifiedLimits::append(const path::Segment& segment, double s0, double feedrate,
                             std::vector<LimitZone>& zones) {
  if (const auto* curve = std::get_if<path::FittedCurve>(&segment.geometry)) {
    append_curve(*curve, s0, feedrate, zones);
  } else if (const auto* passage = std::get_if<path::CornerMotion>(&segment.geometry)) {
    const path::SlowPassage slow = path::slow_passage(*passage);
    zones.push_back({s0, s0 + segment.length, std::min(passage->feedrate, feedrate),
                     slow.acceleration, slow.acceleration, slow.jerk, slow.feedrate});
  } else {
    append_arc(segment, s0, feedrate, zones);
  }
}

}  // namespace twin::feedrate
