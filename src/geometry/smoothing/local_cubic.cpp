#include "geometry/smoothing/local_cubic.hpp"

#include <algorithm>
#include <limits>

namespace twin::geometry {
namespace {

constexpr double kNoMirror = std::numeric_limits<double>::quiet_NaN();

}  // namespace

LocalCubic::LocalCubic(const Stretch& stretch, std::size_t block, double begin, double end) noexcept
    : centre_(0.5 * (begin + end)), half_(0.5 * (end - begin)), inverse_(1.0 / half_) {
  const Polygon& polygon = *stretch.polygon;
  origin_ = polygon[block].aim;
  if (begin < stretch.begin) {
    add_blocks(stretch, stretch.first, stretch.begin, 2.0 * stretch.begin - begin, stretch.begin);
  }
  const double from = std::max(begin, stretch.begin);
  const double to = std::min(end, stretch.end);
  add_blocks(stretch, polygon.block_at(from, block, stretch.first, stretch.last), from, to,
             kNoMirror);
  if (end > stretch.end) {
    const double mirrored = 2.0 * stretch.end - end;
    add_blocks(stretch, polygon.block_at(mirrored, stretch.last, stretch.first, stretch.last),
               mirrored, stretch.end, stretch.end);
  }
  finish();
}

/// Blocks between two arc lengths, as they are or reflected about the one at `mirror`.
void LocalCubic::add_blocks(const Stretch& stretch, std::size_t block, double from, double to,
                            double mirror) noexcept {
  const Polygon& polygon = *stretch.polygon;
  const bool is_mirrored = mirror == mirror;
  const Vec3 twice = is_mirrored
                         ? Vec3(2.0 * (mirror == stretch.begin ? polygon[stretch.first].at
                                                               : polygon[stretch.last + 1].at))
                         : Vec3(Vec3::Zero());
  double s = from;
  Vec3 at = polygon.aim(block, from);
  for (std::size_t i = block; s < to && i <= stretch.last; ++i) {
    const bool is_whole = polygon[i + 1].s <= to;
    const double next = is_whole ? polygon[i + 1].s : to;
    const Vec3 there = is_whole ? polygon[i + 1].aim : polygon.aim(i, to);
    const double share = (next - s) / (polygon[i + 1].s - polygon[i].s);
    const Vec3 bulge = (share * share) * polygon[i].bulge;
    if (is_mirrored) {
      add(2.0 * mirror - next, twice - there, 2.0 * mirror - s, twice - at, -bulge);
    } else {
      add(s, at, next, there, bulge);
    }
    s = next;
    at = there;
  }
}

void LocalCubic::add(double from, const Vec3& start, double to, const Vec3& end,
                     const Vec3& bulge) noexcept {
  constexpr double kThird = 1.0 / 3.0;
  constexpr double kFifth = 1.0 / 5.0;
  const double a = (0.5 * (from + to) - centre_) * inverse_;
  const double d = 0.5 * (to - from) * inverse_;
  const double weight = 2.0 * d;
  const Vec3 middle = 0.5 * (start + end) + (2.0 * kThird) * bulge - origin_;
  const Vec3 slope = 0.5 * (end - start);
  const double aa = a * a;
  const double dd = d * d;
  moment_[0] += weight * middle;
  moment_[1] += (weight * a) * middle + (weight * d * kThird) * slope;
  moment_[2] += (weight * (aa + dd * kThird)) * middle + (weight * 2.0 * kThird * a * d) * slope -
                (weight * (4.0 / 45.0) * dd) * bulge;
  moment_[3] += (weight * a * (aa + dd)) * middle + (weight * d * (aa + dd * kFifth)) * slope -
                (weight * (4.0 / 15.0) * a * dd) * bulge;
  square_ += weight * (middle.squaredNorm() + kThird * slope.squaredNorm() +
                       (4.0 / 45.0) * bulge.squaredNorm());
  ++blocks_;
}

/// Moments of x^k become coefficients of Legendre's polynomials.
void LocalCubic::finish() noexcept {
  const Vec3 l2 = 1.5 * moment_[2] - 0.5 * moment_[0];
  const Vec3 l3 = 2.5 * moment_[3] - 1.5 * moment_[1];
  moment_[0] *= 0.5;
  moment_[1] *= 1.5;
  moment_[2] = 2.5 * l2;
  moment_[3] = 3.5 * l3;
  double explained = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    explained += moment_[k].squaredNorm() * 2.0 / (2.0 * static_cast<double>(k) + 1.0);
  }
  mean_square_ = std::max(0.0, 0.5 * (square_ - explained));
}

Vec3 LocalCubic::blossom(double middle) const noexcept {
  const double x = (middle - centre_) / half_;
  return origin_ + moment_[0] + (x / 3.0) * moment_[1] - moment_[2] - (3.0 * x) * moment_[3];
}

}  // namespace twin::geometry
