#include "results/metrics/block_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/root.hpp"
#include "gcode/programmed_curve.hpp"
#include "results/metrics/nurbs_distance.hpp"

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

/// Minimum of the squared distance within [lo, hi] that holds just one, by Newton's method.
double refine(const geometry::Arc& g, const Vec3& p, View view, double lo, double hi) noexcept {
  if (slope(g, p, view, lo).value >= 0.0) {
    return lo;
  }
  if (slope(g, p, view, hi).value <= 0.0) {
    return hi;
  }
  const auto slope_at = [&](double f) { return slope(g, p, view, f); };
  return bracketed_newton(slope_at, lo, hi, 0.5 * (lo + hi), {-1.0, kSameFraction, kSameFraction})
      .x;
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
