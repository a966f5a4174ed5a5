#include "feedrate/certified/bends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace twin::feedrate {
namespace {

/// Curvature between two samples, over the larger of the two. It follows from how closely curvature
/// is sampled (see the class), and costs 0.15 % of the feedrate in bends.
constexpr double kBetweenSamples = 1.003;

/// How far the curvature in the middle of an interval of a NURBS with a peak may be from the mean of
/// that at its ends, as a share of the largest of the three, and the most halvings of an interval.
/// Twice as much leaves four times what the parabola through the samples does not see; half as much
/// makes half again as many zones at a peak.
constexpr double kNearlyLine = 0.02;
constexpr int kMostDivisions = 8;

/// A bend ends where the curvature has fallen to this share of its peak. A larger share cuts one
/// bend in two, each of which may then seem brief; a smaller one joins neighbours that are two
/// corners.
constexpr double kValley = 0.5;

/// A bend that turns by more than this is no corner: a corner turns by less than pi, which its
/// samples show as up to a fifth more [rad].
constexpr double kWinding = 1.5 * std::numbers::pi;

/// Largest value of the parabola through three samples at equal steps.
double parabola_peak(double a, double middle, double b) {
  const double largest = std::max({a, middle, b});
  const double bend = 0.5 * (a + b) - middle;
  const double slope = 0.5 * (b - a);
  if (!(bend < 0.0) || std::abs(slope) >= -2.0 * bend) {
    return largest;
  }
  return std::max(largest, middle - slope * slope / (4.0 * bend));
}

/// Turn of the tangent between two samples, between which the curvature is nearly a line [rad].
double turn_of(const geometry::CurvatureSample& a, const geometry::CurvatureSample& b) {
  return 0.5 * (a.curvature + b.curvature) * (b.s - a.s);
}

}  // namespace

void Bends::find(const path::FittedCurve& curve) {
  find_intervals(curve);
  peaks_.clear();
  if (!curve.is_programmed && !curve.curvature.empty()) {
    find_brief_bends(curve.curvature.front().curvature, curve.curvature.back().curvature);
  }
}

void Bends::find_intervals(const path::FittedCurve& curve) {
  intervals_.clear();
  for (std::size_t i = 1; i < curve.curvature.size(); ++i) {
    const geometry::CurvatureSample& a = curve.curvature[i - 1];
    const geometry::CurvatureSample& b = curve.curvature[i];
    if (curve.is_programmed && b.s > a.s) {
      divide(curve, a, b, 0);
    } else {
      intervals_.push_back({a.s, b.s, a.u, b.u,
                            kBetweenSamples * std::max(a.curvature, b.curvature), turn_of(a, b)});
    }
  }
}

/// Appends the intervals between two samples of a NURBS of the program.
void Bends::divide(const path::FittedCurve& curve, const geometry::CurvatureSample& a,
                   const geometry::CurvatureSample& b, int depth) {
  const double u = 0.5 * (a.u + b.u);
  const double k = path::point_from(curve.curve.derivatives(u)).curvature.norm();
  const double ends = std::max(a.curvature, b.curvature);
  const double peak = parabola_peak(a.curvature, k, b.curvature);
  const bool is_line =
      std::abs(k - 0.5 * (a.curvature + b.curvature)) <= kNearlyLine * std::max(ends, k);
  if (peak > kBetweenSamples * ends && !is_line && depth < kMostDivisions) {
    const geometry::CurvatureSample middle{
        u, std::clamp(curve.arc_length.s_at(curve.curve, u), a.s, b.s), k};
    divide(curve, a, middle, depth + 1);
    divide(curve, middle, b, depth + 1);
    return;
  }
  intervals_.push_back({a.s, b.s, a.u, b.u, std::max(peak, kBetweenSamples * ends), turn_of(a, b)});
}

/// Finds out which bends are brief.
/// @param first_curvature  at the begin of the curve [1/mm]
/// @param last_curvature   at its end
void Bends::find_brief_bends(double first_curvature, double last_curvature) {
  std::size_t begin = 0;
  while (begin < intervals_.size()) {
    double peak = intervals_[begin].curvature;
    double turn = 0.0;
    double least = std::numeric_limits<double>::infinity();  // since the bend has fallen to half
    std::size_t end = begin;
    for (; end < intervals_.size(); ++end) {
      const double k = intervals_[end].curvature;
      if (k <= kValley * peak) {
        least = std::min(least, k);
      }
      if (k * kValley > least) {
        break;
      }
      peak = std::max(peak, k);
      turn += intervals_[end].turn;
    }
    const bool is_cut = (begin == 0 && first_curvature > kValley * peak) ||
                        (end == intervals_.size() && last_curvature > kValley * peak);
    const bool is_brief = !is_cut && turn < kMostBriefTurn &&
                          1.0 / std::cos(0.5 * turn) - 1.0 <= corner_error_ * peak;
    for (std::size_t i = begin; i < end; ++i) {
      intervals_[i].is_brief = is_brief;
      intervals_[i].is_winding = turn >= kWinding;
    }
    if (is_brief) {
      add_peak(begin, end, turn);
    }
    begin = end;
  }
}

/// Adds the middle of a brief bend: where its two most curved intervals meet.
void Bends::add_peak(std::size_t first, std::size_t last, double turn) {
  const auto most = std::max_element(
      intervals_.begin() + static_cast<std::ptrdiff_t>(first),
      intervals_.begin() + static_cast<std::ptrdiff_t>(last),
      [](const BendInterval& a, const BendInterval& b) { return a.curvature < b.curvature; });
  std::size_t at = static_cast<std::size_t>(most - intervals_.begin());
  if (at + 1 < last && intervals_[at + 1].curvature == most->curvature) {
    ++at;
  }
  BendPeak peak{at, first, last, turn / most->curvature, std::numeric_limits<double>::infinity()};
  if (!peaks_.empty()) {
    BendPeak& before = peaks_.back();
    peak.room = 0.5 * (intervals_[at].begin - intervals_[before.interval].begin);
    before.room = std::min(before.room, peak.room);
  }
  peaks_.push_back(peak);
}

}  // namespace twin::feedrate
