#include "feedrate/limits/zones.hpp"

#include <algorithm>

namespace twin::feedrate {
namespace {

/// Ratio of limits that share a zone which is passed in next to no time. Twice the difference makes
/// half as many such zones, and corners of a micrometre cost a per cent of their time more.
constexpr double kSameBriefLimit = 1.3;

/// A peak of curvature between samples counts where it is this much higher than the next sample.
/// Curves whose curvature is smooth have lower ones.
constexpr double kSharpPeak = 1.02;

/// Places of an arc outside the XY plane at which the rule is asked, where it depends on the
/// heading: every 2 degrees of a circle. Twice as many follow the heading twice as closely.
constexpr std::size_t kArcSamples = 181;

/// Zones between successive samples.
/// @param place  s of sample i, from the segment's start [mm]
/// @param limit  limit at sample i [mm/s]
template <class PlaceOf, class LimitOf>
void append_sampled(std::size_t count, double s0, const PlaceOf& place, const LimitOf& limit_of,
                    std::vector<LimitZone>& zones) {
  ZoneRow row(zones);
  double limit = limit_of(0);
  for (std::size_t i = 1; i < count; ++i) {
    const double next = limit_of(i);
    row.append({s0 + place(i - 1), s0 + place(i), std::min(limit, next)});
    limit = next;
  }
}

/// Curvature at a sample, or beside it where three samples show a peak between them that is more
/// than kSharpPeak higher: that of the parabola through them [1/mm].
double peak_curvature(const std::vector<geometry::CurvatureSample>& samples, std::size_t i) {
  const double here = samples[i].curvature;
  if (i == 0 || i + 1 == samples.size() || here < samples[i - 1].curvature ||
      here < samples[i + 1].curvature) {
    return here;
  }
  const double before = samples[i].s - samples[i - 1].s;
  const double after = samples[i + 1].s - samples[i].s;
  if (!(before > 0.0 && after > 0.0)) {
    return here;
  }
  const double rise = (here - samples[i - 1].curvature) / before;
  const double fall = (samples[i + 1].curvature - here) / after;
  const double slope = (rise * after + fall * before) / (before + after);
  const double bend = (rise - fall) / (before + after);
  const double peak = bend > 0.0 ? here + slope * slope / (4.0 * bend) : here;
  return peak > kSharpPeak * here ? peak : here;
}

void append_curve_limits(const path::FittedCurve& curve, double feedrate, double s0,
                         const FeedrateRules& rules, std::vector<LimitZone>& zones) {
  const bool needs_turning = rules.needs_turning();
  append_sampled(
      curve.curvature.size(), s0, [&](std::size_t i) { return curve.curvature[i].s; },
      [&](std::size_t i) {
        const geometry::CurvatureSample& sample = curve.curvature[i];
        const LocalGeometry at =
            needs_turning ? local_geometry(path::point_from(curve.curve.derivatives(sample.u)))
                          : LocalGeometry{peak_curvature(curve.curvature, i)};
        return rules.limit_at(at, feedrate, On::kCurve);
      },
      zones);
}

void append_tilted_arc_limits(const path::Arc& arc, double feedrate, double s0,
                              const FeedrateRules& rules, std::vector<LimitZone>& zones) {
  const auto place = [&](std::size_t i) {
    return arc.length * static_cast<double>(i) / static_cast<double>(kArcSamples - 1);
  };
  append_sampled(
      kArcSamples, s0, place,
      [&](std::size_t i) {
        return rules.limit_at(local_geometry(path::point_at(arc, place(i))), feedrate,
                              On::kArcOrLine);
      },
      zones);
}

bool is_tilted(const path::Arc& arc) {
  return arc.geometry.e1.z() != 0.0 || arc.geometry.e2.z() != 0.0;
}

/// Lowers the ramps that a zone allows to those that another one allows, too.
void lower_ramp(const LimitZone& by, LimitZone& zone) noexcept {
  if (zone.most > 0.0 || by.most > 0.0) {
    const auto most_of = [](const LimitZone& z) {
      return z.most > 0.0 ? z.most : std::min(z.acceleration, z.deceleration);
    };
    const auto power_of = [](const LimitZone& z) {
      return z.most > 0.0 ? z.power : std::numeric_limits<double>::infinity();
    };
    zone.power = std::min(power_of(zone), power_of(by));
    zone.most = std::min(most_of(zone), most_of(by));
    zone.bend = std::max(zone.bend, by.bend);
    zone.fade_up = std::max(zone.fade_up, by.fade_up);
    zone.fade_down = std::max(zone.fade_down, by.fade_down);
  }
  zone.acceleration = std::min(zone.acceleration, by.acceleration);
  zone.deceleration = std::min(zone.deceleration, by.deceleration);
  zone.jerk = std::min(zone.jerk, by.jerk);
}

}  // namespace

bool has_same_ramp(const LimitZone& a, const LimitZone& b) noexcept {
  return a.acceleration == b.acceleration && a.deceleration == b.deceleration && a.jerk == b.jerk &&
         a.most == b.most && a.bend == b.bend && a.power == b.power && a.fade_up == b.fade_up &&
         a.fade_down == b.fade_down;
}

void ZoneRow::append(const LimitZone& zone) {
  if (!is_empty()) {
    LimitZone& before = zones_.back();
    const double low = std::min(before.limit, zone.limit);
    const double high = std::max(highest_, zone.limit);
    const bool is_same = high <= merging_.same * low && has_same_ramp(before, zone);
    const bool is_brief =
        high <= kSameBriefLimit * low && zone.end - before.begin <= merging_.brief * low;
    if (is_same || is_brief) {
      highest_ = high;
      before.limit = low;
      before.end = zone.end;
      lower_ramp(zone, before);
      return;
    }
  }
  highest_ = zone.limit;
  zones_.push_back(zone);
}

void append_segment_limits(const path::Segment& segment, double s0, double feedrate,
                           const FeedrateRules& rules, std::vector<LimitZone>& zones) {
  if (const auto* curve = std::get_if<path::FittedCurve>(&segment.geometry)) {
    append_curve_limits(*curve, feedrate, s0, rules, zones);
    return;
  }
  const auto* arc = std::get_if<path::Arc>(&segment.geometry);
  if (arc != nullptr && rules.needs_turning() && is_tilted(*arc)) {
    append_tilted_arc_limits(*arc, feedrate, s0, rules, zones);
    return;
  }
  const double begin = segment.begin.curvature.norm();
  const double end = segment.end.curvature.norm();
  const LocalGeometry at = rules.needs_turning()
                               ? local_geometry(begin < end ? segment.end : segment.begin)
                               : LocalGeometry{std::max(begin, end)};
  zones.push_back({s0, s0 + segment.length, rules.limit_at(at, feedrate, On::kArcOrLine)});
}

double curvature_near(SegmentEnd which, const path::Segment& segment, double distance) {
  const bool at_end = which == SegmentEnd::kEnd;
  double largest = (at_end ? segment.end : segment.begin).curvature.norm();
  if (const auto* curve = std::get_if<path::FittedCurve>(&segment.geometry)) {
    const auto take = [&](const geometry::CurvatureSample& sample) {
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
