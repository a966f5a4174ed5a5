#include "results/metrics/block_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/root.hpp"
#include "gcode/block.hpp"

namespace twin::results {
namespace {

using gcode::Block;
using gcode::Motion;

/// Angle between the samples of an arc, just under 15 deg [rad]. A bracket of two samples has to
/// hold one minimum; twice the angle halves the work, and a helix of little rise may hide a
/// minimum.
constexpr double kStep = 0.26;

/// Samples of a round of zooming in; each round divides the interval by half of that.
constexpr int kZoom = 16;

constexpr double kSameFraction = 1e-13;  // two fractions of an arc that are one

/// Half the derivative of the squared distance at f, and the derivative of that.
ValueAndSlope slope(const geometry::Arc& g, const Vec3& p, View view, double f) noexcept {
  const geometry::Derivatives at = derivatives_at(g, f);
  const Vec3 d = seen(at.position - p, view);
  return {d.dot(at.first), seen(at.first, view).squaredNorm() + d.dot(at.second)};
}

/// Minimum of a squared distance within [lo, hi] that holds just one, by Newton's method.
///
/// @param slope_at  half the derivative of the squared distance, and the derivative of that
/// @param same      two arguments so near to each other are one
template <class Slope>
double minimum_between(const Slope& slope_at, double lo, double hi, double same) noexcept {
  if (slope_at(lo).value >= 0.0) {
    return lo;
  }
  if (slope_at(hi).value <= 0.0) {
    return hi;
  }
  return bracketed_newton(slope_at, lo, hi, 0.5 * (lo + hi), {-1.0, same, same}).x;
}

/// Minimum of the squared distance from an arc within [lo, hi] that holds just one.
double refine(const geometry::Arc& g, const Vec3& p, View view, double lo, double hi) noexcept {
  const auto slope_at = [&](double f) { return slope(g, p, view, f); };
  return minimum_between(slope_at, lo, hi, kSameFraction);
}

/// The same by ever finer sampling, for an arc seen edge-on: its twin minima may be as close as
/// they like.
double zoom_in(const geometry::Arc& g, const Vec3& p, View view, double lo, double hi) noexcept {
  double best = lo;
  while (hi - lo > 1e-10) {
    const double from = lo;
    const double step = (hi - lo) / kZoom;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kZoom; ++i) {
      const double f = from + step * i;
      const double d2 = seen(point_at(g, f) - p, view).squaredNorm();
      if (d2 < least) {
        least = d2;
        best = f;
      }
    }
    lo = std::max(best - step, from);
    hi = std::min(best + step, from + step * kZoom);
  }
  return best;
}

bool is_ellipse(const geometry::Arc& g, View view) noexcept {
  return view == View::kAlongZ && std::hypot(g.e1.z(), g.e2.z()) > 1e-9;
}

NearestPoint place_at(const Block& block, const Vec3& point, View view, double f) noexcept {
  const Vec3 at = point_at(block, f);
  return {seen(at - point, view).norm(), f, at};
}

NearestPoint nearest_of_arc(const Block& block, const Vec3& p, View view, double from,
                            double to) noexcept {
  const int pieces =
      std::max(1, static_cast<int>(std::ceil((to - from) * block.arc.sweep / kStep)));
  const auto fraction = [&](int i) {
    return from + (to - from) * std::clamp(i, 0, pieces) / pieces;
  };
  const auto squared = [&](int i) {
    return seen(point_at(block, fraction(i)) - p, view).squaredNorm();
  };
  NearestPoint place;
  place.distance = std::numeric_limits<double>::infinity();
  double before = std::numeric_limits<double>::infinity();
  double here = squared(0);
  for (int i = 0; i <= pieces; ++i) {
    const double after = i < pieces ? squared(i + 1) : std::numeric_limits<double>::infinity();
    if (here <= before && here <= after) {
      const auto search = is_ellipse(block.arc, view) ? zoom_in : refine;
      const double f = search(block.arc, p, view, fraction(i - 1), fraction(i + 1));
      const NearestPoint candidate = place_at(block, p, view, f);
      place = candidate.distance < place.distance ? candidate : place;
    }
    before = here;
    here = after;
  }
  return place;
}

constexpr double kSameParameter = 1e-14;  // two parameters that are one, as a share of the domain

/// One look-up: the curve, the point, and how they are seen.
struct NurbsSearch {
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
    const double same = kSameParameter * (programmed.curve.u_max() - programmed.curve.u_min());
    const auto slope_at = [&](double u) { return slope(u); };
    return minimum_between(slope_at, lo, hi, same);
  }
};

/// Parameters at which a look-up samples: the ends of the range and the samples between them.
class NurbsNodes {
 public:
  NurbsNodes(const gcode::ProgrammedCurve& programmed, double from, double to) noexcept
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

/// nearest() of a NURBS block.
///
/// The samples of the arc length stand a few degrees of turn apart. Around each sample that is
/// nearer than its neighbours, the minimum of the distance is the root of
///   g(u) = (C(u) - p) . C'(u),
/// which Newton's method finds inside the bracket of both neighbours. The curve itself is
/// evaluated, and no chord of it.
NearestPoint nearest_of_nurbs(const Block& block, const Vec3& point, View view, double from,
                              double to) noexcept {
  const gcode::ProgrammedCurve& programmed = *block.nurbs;
  const NurbsSearch search{programmed, point, view};
  const NurbsNodes nodes(programmed, from, to);
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

}  // namespace

Vec3 point_at(const Block& block, double fraction) noexcept {
  switch (block.motion) {
    case Motion::kArc:
      return point_at(block.arc, fraction);
    case Motion::kNurbs: {
      const gcode::ProgrammedCurve& programmed = *block.nurbs;
      const double s = fraction * programmed.arc_length.length();
      return programmed.curve.position(
          programmed.arc_length.u_at(programmed.curve, s, programmed.curve.u_min()));
    }
    case Motion::kDwell:
      return block.start;
    default:
      return block.start + fraction * (block.end - block.start);
  }
}

double block_length(const Block& block, View view) noexcept {
  if (block.motion == Motion::kDwell) {
    return 0.0;
  }
  if (block.motion == Motion::kNurbs) {
    return block.nurbs->arc_length.length();
  }
  if (block.motion != Motion::kArc) {
    return seen(block.end - block.start, view).norm();
  }
  const geometry::Arc& g = block.arc;
  const double around = (g.radius + 0.5 * g.radius_change) * g.sweep;
  return view == View::kAlongZ && !is_ellipse(g, view) ? around : std::hypot(around, g.rise);
}

NearestPoint nearest(const Block& block, const Vec3& point, View view, double from,
                     double to) noexcept {
  if (block.motion == Motion::kArc) {
    return nearest_of_arc(block, point, view, from, to);
  }
  if (block.motion == Motion::kNurbs) {
    return nearest_of_nurbs(block, point, view, from, to);
  }
  if (block.motion == Motion::kDwell) {
    return place_at(block, point, view, 0.0);
  }
  const Vec3 way = seen(block.end - block.start, view);
  const double squared = way.squaredNorm();
  const double foot = squared > 0.0 ? seen(point - block.start, view).dot(way) / squared : 0.0;
  return place_at(block, point, view, std::clamp(foot, from, to));
}

}  // namespace twin::results
