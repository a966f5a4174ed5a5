#include "feedrate/segment_limits.hpp"

#include <algorithm>

#include "feedrate/curvature_limit.hpp"

namespace twin::feedrate {
namespace {

constexpr double kSameLimit = 1.01;  // ratio of limits that share a zone

void append_curve_limits(const path::FittedCurve& curve, double feedrate, double s0,
                         const PlanningModel& model, const Limits& limits,
                         std::vector<LimitZone>& zones) {
  const auto limit_of = [&](const nurbs::CurvatureSample& sample) {
    return curvature_feedrate(sample.curvature, feedrate, model, limits);
  };
  const std::size_t first = zones.size();
  double highest = 0.0;  // of the limits in the zone under way
  double limit = limit_of(curve.curvature.front());
  for (std::size_t i = 1; i < curve.curvature.size(); ++i) {
    const double next = limit_of(curve.curvature[i]);
    const LimitZone zone{s0 + curve.curvature[i - 1].s, s0 + curve.curvature[i].s,
                         std::min(limit, next)};
    limit = next;
    if (zones.size() > first) {
      LimitZone& last = zones.back();
      const double low = std::min(last.limit, zone.limit);
      if (std::max(highest, zone.limit) <= kSameLimit * low) {
        highest = std::max(highest, zone.limit);
        last.limit = low;
        last.end = zone.end;
        continue;
      }
    }
    highest = zone.limit;
    zones.push_back(zone);
  }
}

}  // namespace

void append_segment_limits(const path::Segment& segment, double s0, const PlanningModel& model,
                           const Limits& limits, std::vector<LimitZone>& zones) {
  if (const auto* curve = std::get_if<path::FittedCurve>(&segment.geometry)) {
    append_curve_limits(*curve, segment.feedrate, s0, model, limits, zones);
    return;
  }
  const double curvature = std::max(segment.begin.curvature.norm(), segment.end.curvature.norm());
  const double limit = curvature_feedrate(curvature, segment.feedrate, model, limits);
  zones.push_back({s0, s0 + segment.length, limit});
}

double curvature_near_end(const path::Segment& segment, bool at_end, double distance) {
  double largest = (at_end ? segment.end : segment.begin).curvature.norm();
  if (const auto* curve = std::get_if<path::FittedCurve>(&segment.geometry)) {
    const auto take = [&](const nurbs::CurvatureSample& sample) {
      const double away = at_end ? segment.length - sample.s : sample.s;
      if (away > distance) {
        return false;
      }
      largest = std::max(largest, sample.curvature);
      return true;
    };
    if (at_end) {
      std::all_of(curve->curvature.rbegin(), curve->curvature.rend(), take);
    } else {
      std::all_of(curve->curvature.begin(), curve->curvature.end(), take);
    }
  }
  return largest;
}

}  // namespace twin::feedrate
