#include "results/metrics/nurbs_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/root.hpp"
#include "gcode/programmed_curve.hpp"

namespace twin::results {
namespace {

constexpr double kSameParameter = 1e-14;  // two parameters that are one, as a share of the domain

/// One look-up: the curve, the point, and how they are seen.
struct Search {
  const gcode::ProgrammedCurve& programmed;
  const Vec3& p;
  View view;

  double squared(double u) const noexcept {
    return seen(programmed.curve.position(u) - p, view).squaredNorm();
  }

  /// g and dg/du.
  ValueAndSlope slope(double u) const noexcept {
    const geometry::Derivatives at = programmed.curve.derivatives(u);
    const Vec3 d = seen(at.position - p, view);
    return {d.dot(at.first), seen(at.first, view).squaredNorm() + d.dot(at.second)};
  }

  /// Minimum within [lo, hi] that holds just one.
  double refine(double lo, double hi) const noexcept {
    if (slope(lo).value >= 0.0) {
      return lo;
    }
    if (slope(hi).value <= 0.0) {
      return hi;
    }
    const double same = kSameParameter * (programmed.curve.u_max() - programmed.curve.u_min());
    const auto slope_at = [&](double u) { return slope(u); };
    return bracketed_newton(slope_at, lo, hi, 0.5 * (lo + hi), {-1.0, same, same}).x;
  }
};

/// Parameters at which a look-up samples: the ends of the range and the samples between them.
class Nodes {
 public:
  Nodes(const gcode::ProgrammedCurve& programmed, double from, double to) noexcept
      : samples_(programmed.samples) {
    const auto s_less = [](const geometry::CurvatureSample& a, double s) { return a.s < s; };
    const double length = programmed.arc_length.length();
    const auto lo = std::lower_bound(samples_.begin(), samples_.end(), from * length, s_less);
    const auto hi = std::lower_bound(lo, samples_.end(), to * length, s_less);
    first_ = lo - samples_.begin();
    count_ = hi - lo;
    const auto u_at = [&](double fraction, auto near) {
      const double guess = near == samples_.end() ? programmed.curve.u_max() : near->u;
      return programmed.arc_length.u_at(programmed.curve, fraction * length, guess);
    };
    begin_ = u_at(from, lo);
    end_ = u_at(to, hi);
  }

  std::ptrdiff_t last() const noexcept { return count_ + 1; }

  /// Node i, clamped to 0..last().
  double at(std::ptrdiff_t i) const noexcept {
    if (i <= 0) {
      return begin_;
    }
    return i > count_ ? end_ : samples_[static_cast<std::size_t>(first_ + i - 1)].u;
  }

 private:
  const std::vector<geometry::CurvatureSample>& samples_;
  std::ptrdiff_t first_ = 0;
  std::ptrdiff_t count_ = 0;
  double begin_ = 0.0;
  double end_ = 0.0;
};

}  // namespace

NearestPoint nearest_of_nurbs(const gcode::Block& block, const Vec3& point, View view, double from,
                              double to) noexcept {
  const gcode::ProgrammedCurve& programmed = *block.nurbs;
  const Search search{programmed, point, view};
  const Nodes nodes(programmed, from, to);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  double least = kFar;
  double best = nodes.at(0);
  double before = kFar;
  double here = search.squared(nodes.at(0));
  for (std::ptrdiff_t i = 0; i <= nodes.last(); ++i) {
    const double after = i < nodes.last() ? search.squared(nodes.at(i + 1)) : kFar;
    if (here <= before && here <= after) {
      const double u = search.refine(nodes.at(i - 1), nodes.at(i + 1));
      if (const double squared = search.squared(u); squared < least) {
        least = squared;
        best = u;
      }
    }
    before = here;
    here = after;
  }
  const double s = programmed.arc_length.s_at(programmed.curve, best);
  return {std::sqrt(least), std::clamp(s / programmed.arc_length.length(), from, to),
          programmed.curve.position(best)};
}

}  // namespace twin::results
