#include "geometry/smoothing/path_moments.hpp"

#include <algorithm>
#include <limits>

namespace twin::geometry {
namespace {

constexpr double kNoMirror = std::numeric_limits<double>::quiet_NaN();

}  // namespace

PathMoments::PathMoments(const Stretch& stretch, std::size_t block, double begin,
                         double end) noexcept
    : begin_(begin), end_(end), centre_(0.5 * (begin + end)), inverse_(2.0 / (end - begin)) {
  const Polygon& polygon = *stretch.polygon;
  const double from = std::max(begin, stretch.begin);
  const double to = std::min(end, stretch.end);
  const std::size_t first = polygon.block_at(from, block, stretch.first, stretch.last);
  origin_ = polygon[first].aim;
  begins_inside_ = from > polygon[first].s && begin != stretch.end;
  const auto block_of = [&](double s) {
    return polygon.block_at(s, first, stretch.first, stretch.last);
  };
  if (begin < stretch.begin) {
    const double nearest = 2.0 * stretch.begin - std::min(end, stretch.begin);
    add_blocks(stretch, block_of(nearest), nearest, 2.0 * stretch.begin - begin, stretch.begin);
  }
  add_blocks(stretch, first, from, to, kNoMirror);
  if (end > stretch.end) {
    const double farthest = 2.0 * stretch.end - end;
    add_blocks(stretch, block_of(farthest), farthest,
               2.0 * stretch.end - std::max(begin, stretch.end), stretch.end);
  }
}

/// Blocks between two arc lengths, as they are or reflected about the one at `mirror`.
void PathMoments::add_blocks(const Stretch& stretch, std::size_t block, double from, double to,
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
    const Polygon::Vertex& vertex = polygon[i];
    const Polygon::Vertex& beyond = polygon[i + 1];
    const bool is_whole = beyond.s <= to;
    const double next = is_whole ? beyond.s : to;
    const Vec3 there = is_whole ? beyond.aim : polygon.aim(i, to);
    const double share = (next - s) / (beyond.s - vertex.s);
    const Vec3 bulge = (share * share) * vertex.bulge;
    if (is_mirrored) {
      add(2.0 * mirror - next, twice - there, 2.0 * mirror - s, twice - at, -bulge);
    } else {
      add(s, at, next, there, bulge);
    }
    s = next;
    at = there;
  }
}

void PathMoments::add(double from, const Vec3& start, double to, const Vec3& end,
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

}  // namespace twin::geometry
