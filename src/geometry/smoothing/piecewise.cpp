#include "geometry/smoothing/piecewise.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace twin::geometry {
namespace {

Vec3 blossom(const geometry::SpanCubic& p, double a, double b, double c) noexcept {
  a -= p.begin;
  b -= p.begin;
  c -= p.begin;
  return p.c0 + ((a + b + c) / 3.0) * p.c1 + ((a * b + b * c + c * a) / 3.0) * p.c2 +
         (a * b * c) * p.c3;
}

}  // namespace

geometry::SpanCubic part_of(const geometry::SpanCubic& p, double begin, double end) noexcept {
  const double t = begin - p.begin;
  return {begin,
          end,
          p.c0 + t * (p.c1 + t * (p.c2 + t * p.c3)),
          p.c1 + t * (2.0 * p.c2 + (3.0 * t) * p.c3),
          p.c2 + (3.0 * t) * p.c3,
          p.c3};
}

void split_at(double s, std::vector<geometry::SpanCubic>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const geometry::SpanCubic whole = pieces[i];
    const double least = shortest_part(whole);
    if (s < whole.begin + least || s > whole.end - least) {
      continue;
    }
    pieces[i].end = s;
    pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                  part_of(whole, s, whole.end));
    return;
  }
}

geometry::Curve curve_from_pieces(std::span<const geometry::SpanCubic> pieces) {
  const std::size_t n = pieces.size();
  const double origin = pieces.front().begin;
  std::vector<double> knots;
  knots.reserve(n + 7);
  knots.insert(knots.end(), 4, 0.0);
  for (std::size_t k = 1; k < n; ++k) {
    knots.push_back(pieces[k].begin - origin);
  }
  knots.insert(knots.end(), 4, pieces.back().end - origin);
  std::vector<Vec3> points(n + 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t highest = std::min(i, n - 1);
    std::size_t widest = i > 3 ? i - 3 : 0;
    for (std::size_t k = widest + 1; k <= highest; ++k) {
      const auto width = [&](std::size_t j) { return pieces[j].end - pieces[j].begin; };
      widest = width(k) > width(widest) ? k : widest;
    }
    points[i] = blossom(pieces[widest], origin + knots[i + 1], origin + knots[i + 2],
                        origin + knots[i + 3]);
  }
  auto curve = geometry::Curve::create(3, std::move(knots), std::move(points));
  assert(curve.has_value());
  return std::move(*curve);
}

}  // namespace twin::geometry
