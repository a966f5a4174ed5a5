#include "geometry/smoothing/chord_deviation.hpp"

#include <algorithm>
#include <cmath>

namespace twin::geometry {
namespace {

double squared_distance(const Vec3& point, const Polygon::Vertex& from, double length) noexcept {
  const Vec3 way = point - from.at;
  const double along = std::clamp(way.dot(from.direction), 0.0, length);
  return (way - along * from.direction).squaredNorm();
}

}  // namespace

Deviation chord_deviation(const geometry::SpanCubic& cubic, const Polygon& polygon,
                          std::size_t block, std::size_t highest) noexcept {
  double largest = 0.0;
  std::size_t worst = block;
  double s = cubic.begin;
  Vec3 at = cubic.c0;
  Vec3 slope = cubic.c1;
  for (std::size_t i = block; i <= highest && s < cubic.end; ++i) {
    const Polygon::Vertex& from = polygon[i];
    const Polygon::Vertex& to = polygon[i + 1];
    const double next = std::min(to.s, cubic.end);
    const double third = (next - s) / 3.0;
    const double t = next - cubic.begin;
    const Vec3 there = cubic.c0 + t * (cubic.c1 + t * (cubic.c2 + t * cubic.c3));
    const Vec3 slope_there = cubic.c1 + t * (2.0 * cubic.c2 + (3.0 * t) * cubic.c3);
    const double length = to.s - from.s;
    double square = std::max({squared_distance(at, from, length),
                              squared_distance(at + third * slope, from, length),
                              squared_distance(there - third * slope_there, from, length),
                              squared_distance(there, from, length)});
    if (to.s <= cubic.end) {
      square = std::max(square, (there - to.at).squaredNorm());
    }
    if (square > largest) {
      largest = square;
      worst = i;
    }
    s = next;
    at = there;
    slope = slope_there;
  }
  return {std::sqrt(largest), worst};
}

}  // namespace twin::geometry
