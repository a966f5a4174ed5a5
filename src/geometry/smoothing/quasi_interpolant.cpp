#include "geometry/smoothing/quasi_interpolant.hpp"

#include <algorithm>
#include <array>

#include "geometry/gauss_legendre.hpp"

namespace twin::geometry {
namespace {

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

/// Place of the last vertex of a run that is closed [mm].
const Vec3& end_of(const KnownRun& run) noexcept {
  return (*run.stretch.polygon)[run.stretch.last + 1].at;
}

}  // namespace

void QuasiInterpolant::begin_at(const Vec3& at) {
  begin_ = at;
  raw_.restart(0);
  points_.restart(0);
}

void QuasiInterpolant::extend(const KnownRun& run) {
  const std::size_t k = knots_.last();
  if (k >= 2) {
    const std::array<PathMoments, 2> parts{
        knots_.moments(run.stretch, knots_.block(k - 2), knots_.at(k - 2), knots_.at(k - 1)),
        knots_.moments(run.stretch, knots_.block(k - 1), knots_.at(k - 1), knots_.at(k))};
    const LocalCubic cubic(parts);
    const Vec3 point = cubic.blossom(knots_.at(k - 1));
    if (k == 2) {
      begin_reflected(begin_, point, raw_);
    }
    raw_.push_back(point);
  }
  if (knots_.is_marched(run)) {
    end_reflected(end_of(run), raw_);
  }
  correct(run);
}

/// The control points P that the points Q decide.
void QuasiInterpolant::correct(const KnownRun& run) {
  while (std::max<std::size_t>(points_.end_index(), 2) + 2 < raw_.end_index()) {
    const std::size_t i = std::max<std::size_t>(points_.end_index(), 2);
    const Vec3 point = 2.0 * raw_[i] - refitted(i);
    if (i == 2) {
      begin_reflected(begin_, point, points_);
    }
    points_.push_back(point);
  }
  if (knots_.is_marched(run)) {
    end_reflected(end_of(run), points_);
  }
}

/// Q_{i-3}[Q[V]]: what the spline through the points Q gives in the place of Q_{i-3}.
Vec3 QuasiInterpolant::refitted(std::size_t i) const noexcept {
  using FivePoints = gauss::Rule<5>;
  const auto j = static_cast<std::ptrdiff_t>(i);
  const BlossomKernel kernel(knots_.reflected(j - 2), knots_.reflected(j - 1), knots_.reflected(j));
  Vec3 sum = Vec3::Zero();
  for (const std::size_t span : {i - 2, i - 1}) {
    const SpanCubic cubic = cubic_of(raw_, span);
    const double half = 0.5 * (cubic.end - cubic.begin);
    for (std::size_t k = 0; k < 5; ++k) {
      const double s = cubic.begin + half * (1.0 + FivePoints::kNodes[k]);
      sum += (half * FivePoints::kWeights[k] * kernel.at(s)) * (cubic.position(s) - raw_[i]);
    }
  }
  return raw_[i] + sum;
}

SpanCubic QuasiInterpolant::cubic_of(const SlidingVector<Vec3>& points,
                                     std::size_t span) const noexcept {
  std::array<double, 6> u{};
  for (std::size_t k = 0; k < u.size(); ++k) {
    u[k] = knots_.reflected(static_cast<std::ptrdiff_t>(span + k) - 2);
  }
  return span_cubic(SpanView{&u[2], &points[span], nullptr});
}

void QuasiInterpolant::truncate(std::size_t last) {
  raw_.truncate(last >= 2 ? last + 1 : 0);
  points_.truncate(last >= kReach - 1 ? last - 1 : 0);
}

void QuasiInterpolant::drop_before(std::size_t j) {
  raw_.drop_before(j);
  points_.drop_before(j);
}

}  // namespace twin::geometry
