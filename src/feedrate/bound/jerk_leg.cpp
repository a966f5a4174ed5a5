#include "feedrate/bound/jerk_leg.hpp"

#include <algorithm>
#include <cmath>

#include "core/root.hpp"

namespace twin::feedrate {
namespace {

/// How closely the peak of a leg is found: a share of its length, and of the peak. Ten times more
/// would make the bound too low by as much.
constexpr double kSameWay = 1e-6;
constexpr double kSamePeak = 1e-12;

/// Lowest peak that a side can have [mm/s].
double lowest_peak(const LegEnd& end, const RampLimits& ramp) noexcept {
  return end.a < 0.0 ? end.v - end.a * end.a / (2.0 * ramp.jerk) : 0.0;
}

/// Way of a time of constant jerk.
double way(double v, double a, double j, double t) noexcept {
  return t * (v + t * (0.5 * a + t * j / 6.0));
}

/// Least time of a leg that ends within the dip of one of its ends [s]; 0 where it does not.
double time_in_dip(const LegEnd& end, double length, const RampLimits& ramp) noexcept {
  const double bottom = -end.a / ramp.jerk;
  const auto over_at = [&](double t) { return way(end.v, end.a, ramp.jerk, t) - length; };
  const double over = end.a < 0.0 ? over_at(bottom) : -1.0;
  return over > 0.0 ? root_from_below(over_at, 0.0, -length, bottom, over,
                                      {kSameWay * length, kSamePeak, 60, 3})
                    : 0.0;
}

}  // namespace

LegSide leg_side(const LegEnd& end, double peak, const RampLimits& ramp) noexcept {
  const double j = ramp.jerk;
  LegSide side{0.0, 0.0};
  double v = std::min(end.v, peak);
  double a = end.a;
  if (a < 0.0) {
    const double t = -a / j;
    side = {way(end.v, a, j, t), t};
    v = std::min(end.v - 0.5 * a * a / j, peak);
    a = 0.0;
  } else if (end.v > peak && end.least < 0.0) {
    const double t = std::min(-end.least / j, std::sqrt(2.0 * (end.v - peak) / j));
    return {-way(peak, 0.0, -j, t), -t};  // it begins beyond the peak
  }
  a = std::min(a, std::sqrt(2.0 * j * (peak - v)));
  const double most =
      std::max(a, std::min(ramp.acceleration, std::sqrt(j * (peak - v) + 0.5 * a * a)));
  const double rise = (most - a) / j;
  const double fall = most / j;
  const double v_rise = v + rise * (a + 0.5 * j * rise);
  const double v_fall = peak - 0.5 * j * fall * fall;
  const double hold = most > 0.0 ? std::max(v_fall - v_rise, 0.0) / most : 0.0;
  side.distance +=
      way(v, a, j, rise) + hold * 0.5 * (v_rise + v_fall) + fall * (peak - j * fall * fall / 6.0);
  side.time += rise + hold + fall;
  return side;
}

double shortest_time(double length, double cap, const LegEnd& begin, const LegEnd& end,
                     const RampLimits& ramp) noexcept {
  const auto sides = [&](double peak) {
    const LegSide a = leg_side(begin, peak, ramp);
    const LegSide b = leg_side(end, peak, ramp);
    return LegSide{a.distance + b.distance, a.time + b.time};
  };
  const double turn = std::max(-(begin.a + end.a), 0.0) / ramp.jerk;
  const LegSide at_cap = sides(cap);
  if (at_cap.distance <= length) {
    return std::max(turn, at_cap.time + (length - at_cap.distance) / cap);
  }
  double low = std::min(cap, std::max(lowest_peak(begin, ramp), lowest_peak(end, ramp)));
  const LegSide at_low = sides(low);
  if (at_low.distance > length) {
    return std::max(
        {turn, length / cap, time_in_dip(begin, length, ramp), time_in_dip(end, length, ramp)});
  }
  const auto over_at = [&](double peak) { return sides(peak).distance - length; };
  low = root_from_below(over_at, low, at_low.distance - length, cap, at_cap.distance - length,
                        {kSameWay * length, kSamePeak, 60, 3});
  return std::max(turn, sides(low).time);
}

}  // namespace twin::feedrate
