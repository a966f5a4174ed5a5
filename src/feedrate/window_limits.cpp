#include "feedrate/window_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate {
namespace {

/// Halvings of a range of feedrates: as many as its digits.
constexpr int kDescentHalvings = 50;

/// Over what a motion can reach. It is what rounding needs.
constexpr double kOverReach = 1.001;

/// Feedrate that no motion from rest exceeds after a distance: J up to A, and A from there on.
///   s = J t^3 / 6,  v = J t^2 / 2,  then  v^2 = v_A^2 + 2 A (s - s_A)   with  t_A = A / J
double reach_from_rest(double distance, const RampLimits& ramp) {
  const double build_up = ramp.acceleration / ramp.jerk;
  const double way = ramp.jerk * build_up * build_up * build_up / 6.0;
  if (distance <= way) {
    return 0.5 * std::cbrt(36.0 * ramp.jerk * distance * distance);
  }
  const double v = 0.5 * ramp.acceleration * build_up;
  return std::sqrt(v * v + 2.0 * ramp.acceleration * (distance - way));
}

}  // namespace

WindowLimits::WindowLimits(const Limits& limits, const PlanningModel& model, double period,
                           std::unique_ptr<LimitSource> source, const PlanStart& start,
                           double override_scale)
    : limits_(limits),
      source_(std::move(source)),
      junctions_(limits, model, period),
      start_(start),
      latest_rest_(start),
      ramp_{limits.acceleration, limits.jerk, model.acceleration_profile},
      override_scale_(override_scale) {}

/// Feedrate that no motion exceeds on a segment: from the latest rest or the start on, which adds its
/// feedrate, and down to a rest at the segment's end [mm/s].
double WindowLimits::reach(const path::Segment& segment, double begin) const {
  const double end = begin + segment.length;
  if (begin < latest_rest_.s) {  // not passed, or not from its begin
    return std::numeric_limits<double>::infinity();
  }
  double reach = latest_rest_.v + reach_from_rest(end - latest_rest_.s, ramp_);
  if (segment.stops_at_end) {
    reach = std::min(reach, reach_from_rest(segment.length, ramp_));
  }
  return kOverReach * reach;
}

double WindowLimits::asked_feedrate(const path::Segment& segment) const {
  if (override_scale_ == 1.0) {
    return segment.feedrate;
  }
  const double scale = segment.is_rapid ? std::min(override_scale_, 1.0) : override_scale_;
  return std::min(scale * segment.feedrate, std::max(limits_.feedrate, segment.feedrate));
}

void WindowLimits::append(const path::Segment& segment, Window& window) {
  if (!window.segments.empty()) {
    junctions_.append(window.segments.back(), segment, window.length, window.zones);
  }
  double asked = asked_feedrate(segment);
  window.fastest = std::max(window.fastest, asked);
  if (source_->divides_jerk() && segment.length > 0.0 &&
      !std::holds_alternative<path::CornerMotion>(segment.geometry)) {
    asked = std::min(asked, std::max(reach(segment, window.length), start_.v));
  }
  if (segment.stops_at_end || segment.length == 0.0) {
    latest_rest_ = {std::max(window.length + segment.length, start_.s), 0.0};
  }
  const double down =
      asked < start_.v
          ? start_.s + ramp_distance(start_.v, asked, source_->least_ramp()) - window.length
          : 0.0;
  if (down > 0.0 && std::holds_alternative<path::CornerMotion>(segment.geometry)) {
    append_passage(segment, asked, window);
    return;
  }
  if (down > 0.0 && segment.length > 0.0) {
    append_descent(segment, asked, down, window);
    return;
  }
  const std::size_t first = window.zones.size();
  source_->append(segment, window.length, asked, window.zones);
  if (first > 0 && first < window.zones.size()) {
    source_->merge(window.zones, first);
  }
}

/// Appends the limit of a passage on the way down from the start's feedrate. The motion comes down as
/// far as it can before the passage, and goes on coming down after it.
void WindowLimits::append_passage(const path::Segment& segment, double asked, Window& window) {
  const double room = std::max(window.length - start_.s, 0.0);
  double high = start_.v;  // can be had
  double low = asked;
  for (int i = 0; i < kDescentHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (ramp_distance(start_.v, middle, source_->least_ramp()) <= room ? high : low) = middle;
  }
  source_->append(segment, window.length, high, window.zones);
  start_ = {window.length + segment.length, std::min(high, window.zones.back().limit)};
}

/// Appends the limits of a segment on which the start's feedrate comes down to the one asked for.
/// Over the distance `down` the start's feedrate is asked for, then the segment's own.
void WindowLimits::append_descent(const path::Segment& segment, double asked, double down,
                                  Window& window) {
  std::vector<LimitZone>& zones = window.zones;
  const std::size_t first = zones.size();
  const double border = window.length + std::min(down, segment.length);
  source_->append(segment, window.length, start_.v, zones);
  std::erase_if(zones, [&](const LimitZone& zone) { return zone.begin >= border; });
  asked_zones_.clear();
  source_->append(segment, window.length, asked, asked_zones_);
  if (zones.size() > first) {
    zones.back().end = std::min(zones.back().end, border);
  }
  for (LimitZone zone : asked_zones_) {
    if (zone.end > border) {
      zone.begin = std::max(zone.begin, border);
      zones.push_back(zone);
    }
  }
}

void WindowLimits::forget(double distance, std::size_t zones) {
  junctions_.forget(distance, zones);
  start_.s -= distance;
  latest_rest_.s -= distance;
}

}  // namespace twin::feedrate
