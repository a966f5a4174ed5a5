/// Knots, control points and spans of RunSpline.
#include <algorithm>
#include <array>

#include "geometry/gauss_legendre.hpp"
#include "geometry/smoothing/run_spline.hpp"

namespace twin::geometry {
namespace {

using FivePoints = gauss::Rule<5>;

/// Begins a row of points at a run's begin, before its first inner point: reflected about it.
void begin_reflected(const Vec3& at, const Vec3& first, SlidingVector<Vec3>& points) {
  points.push_back(2.0 * at - first);
  points.push_back(at);
}

/// Ends a row of points at a run's end: the last inner point, reflected about it, follows.
void end_reflected(const Vec3& at, SlidingVector<Vec3>& points) {
  const Vec3 before = points.back();
  points.push_back(at);
  points.push_back(2.0 * at - before);
}

}  // namespace

/// t_j, also of the reflected knots beyond the run's ends.
double RunSpline::knot(std::ptrdiff_t j) const noexcept {
  if (j < 0) {
    return 2.0 * begin_ - knots_[static_cast<std::size_t>(-j)].s;
  }
  const auto last = static_cast<std::ptrdiff_t>(last_knot());
  return j <= last ? knots_[static_cast<std::size_t>(j)].s
                   : 2.0 * knots_.back().s - knots_[static_cast<std::size_t>(2 * last - j)].s;
}

/// The points Q that the latest knot decides, and what follows from them.
void RunSpline::place_points() {
  const std::size_t k = last_knot();
  if (k >= 2) {
    const Knot& from = knots_[k - 2];
    const LocalCubic cubic(stretch(), from.block, from.s, knots_[k].s);
    const Vec3 point = cubic.blossom(knots_[k - 1].s);
    if (k == 2) {
      begin_reflected(begin_at_, point, raw_);
    }
    raw_.push_back(point);
  }
  if (is_marched()) {
    end_reflected(polygon_[end_vertex_].at, raw_);
  }
  correct_points();
}

/// The control points P that the points Q decide.
void RunSpline::correct_points() {
  while (std::max<std::size_t>(points_.end_index(), 2) + 2 < raw_.end_index()) {
    const std::size_t i = std::max<std::size_t>(points_.end_index(), 2);
    const Vec3 point = 2.0 * raw_[i] - refitted(i);
    if (i == 2) {
      begin_reflected(begin_at_, point, points_);
    }
    points_.push_back(point);
  }
  if (is_marched()) {
    end_reflected(polygon_[end_vertex_].at, points_);
  }
}

/// What the spline through the points Q gives in the place of Q_{i-3}.
Vec3 RunSpline::refitted(std::size_t i) const noexcept {
  const auto j = static_cast<std::ptrdiff_t>(i);
  const BlossomKernel kernel(knot(j - 2), knot(j - 1), knot(j));
  Vec3 sum = Vec3::Zero();
  for (const std::size_t span : {i - 2, i - 1}) {
    const geometry::SpanCubic cubic = cubic_of(raw_, span);
    const double half = 0.5 * (cubic.end - cubic.begin);
    for (int k = 0; k < 5; ++k) {
      const double s = cubic.begin + half * (1.0 + FivePoints::kNodes[k]);
      sum += (half * FivePoints::kWeights[k] * kernel.at(s)) * (cubic.position(s) - raw_[i]);
    }
  }
  return raw_[i] + sum;
}

geometry::SpanCubic RunSpline::cubic_of(const SlidingVector<Vec3>& points,
                                        std::size_t span) const noexcept {
  std::array<double, 6> u{};
  for (std::size_t k = 0; k < u.size(); ++k) {
    u[k] = knot(static_cast<std::ptrdiff_t>(span + k) - 2);
  }
  return geometry::span_cubic(geometry::SpanView{&u[2], &points[span], nullptr});
}

}  // namespace twin::geometry
