#include "geometry/smoothing/local_cubic.hpp"

#include <algorithm>

namespace twin::geometry {

LocalCubic::LocalCubic(std::span<const PathMoments> parts) noexcept
    : centre_(0.5 * (parts.front().begin() + parts.back().end())),
      half_(0.5 * (parts.back().end() - parts.front().begin())),
      origin_(parts[parts.size() / 2].origin()) {
  for (const PathMoments& part : parts) {
    add(part);
  }
  blocks_ += parts.front().begins_inside() ? 1 : 0;
  finish();
}

/// Eq. (2), and the same of the square. A block that two parts share counts once.
void LocalCubic::add(const PathMoments& part) noexcept {
  const double a = (0.5 * (part.begin() + part.end()) - centre_) / half_;
  const double d = 0.5 * (part.end() - part.begin()) / half_;
  const Vec3 away = part.origin() - origin_;
  const std::array<Vec3, 4>& m = part.moments();
  const Vec3 m0 = m[0] + 2.0 * away;
  const Vec3& m1 = m[1];
  const Vec3 m2 = m[2] + (2.0 / 3.0) * away;
  const Vec3& m3 = m[3];
  const double aa = a * a;
  const double dd = d * d;
  moment_[0] += d * m0;
  moment_[1] += (d * a) * m0 + dd * m1;
  moment_[2] += (d * aa) * m0 + (2.0 * a * dd) * m1 + (d * dd) * m2;
  moment_[3] += (d * a * aa) * m0 + (3.0 * aa * dd) * m1 + (3.0 * a * d * dd) * m2 + (dd * dd) * m3;
  square_ += d * (part.square() + 2.0 * away.dot(m[0]) + 2.0 * away.squaredNorm());
  blocks_ += part.blocks() - (part.begins_inside() ? 1 : 0);
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
