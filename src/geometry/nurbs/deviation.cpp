#include "geometry/nurbs/deviation.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "geometry/nurbs/span_cubic.hpp"

namespace twin::geometry {
namespace {

constexpr int kSteps = 4;  // parts of the parameter between two points

/// What the bound needs of one piece of the curve, between points A and B of the polygon.
struct Piece {
  std::array<Vec3, kSteps - 1> inner;  // C(u_k) - A [mm]
  double second_squared = 0.0;         // max |C''|^2
  double normal_squared = 0.0;         // max |C''_n|^2
};

/// Walks along a curve and keeps the polynomial of the span it is in.
class SpanWalk {
 public:
  explicit SpanWalk(const Curve& curve) noexcept
      : curve_(curve), span_(curve.degree()), cubic_(span_cubic(curve, span_)) {}

  const SpanCubic& cubic() const noexcept { return cubic_; }
  bool is_last() const noexcept { return cubic_.end >= curve_.u_max(); }

  void next() noexcept {
    const std::vector<double>& knots = curve_.knots();
    do {
      ++span_;
    } while (!(knots[span_] < knots[span_ + 1]));
    cubic_ = span_cubic(curve_, span_);
  }

 private:
  const Curve& curve_;
  int span_;
  SpanCubic cubic_;
};

void take_second(const Vec3& second, const Vec3& direction, Piece& piece) {
  const Vec3 normal = second - second.dot(direction) * direction;
  piece.second_squared = std::max(piece.second_squared, second.squaredNorm());
  piece.normal_squared = std::max(piece.normal_squared, normal.squaredNorm());
}

Piece sample_piece(SpanWalk& walk, double from, double to, const Vec3& origin,
                   const Vec3& direction) {
  Piece piece;
  const auto advance_to = [&](double u) {
    while (walk.cubic().end <= u && !walk.is_last()) {
      walk.next();
      take_second(2.0 * walk.cubic().c2, direction, piece);
    }
  };
  const double step = (to - from) / kSteps;
  take_second(walk.cubic().second(from), direction, piece);
  for (int k = 1; k < kSteps; ++k) {
    const double u = from + k * step;
    advance_to(u);
    piece.inner[k - 1] = walk.cubic().position(u) - origin;
  }
  advance_to(to);
  take_second(walk.cubic().second(to), direction, piece);
  return piece;
}

/// Bound of the distance of one piece from the chord of the given length and direction that starts
/// at the origin.
double piece_bound(const Piece& piece, double step, const Vec3& direction, double length) {
  const double second = std::sqrt(piece.second_squared);
  const double reach = 0.5 * step * step * second;
  double beside = 0.0;
  double from_chord = 0.0;
  bool stays_between = true;
  for (const Vec3& point : piece.inner) {
    const double along = point.dot(direction);
    const double normal_squared = (point - along * direction).squaredNorm();
    const double beyond = std::max({0.0, -along, along - length});
    stays_between = stays_between && along >= reach && along <= length - reach;
    beside = std::max(beside, normal_squared);
    from_chord = std::max(from_chord, normal_squared + beyond * beyond);
  }
  const double factor = 0.125 * step * step;
  return stays_between ? std::sqrt(beside) + factor * std::sqrt(piece.normal_squared)
                       : std::sqrt(from_chord) + factor * second;
}

}  // namespace

double deviation_bound(const Curve& curve, std::span<const Vec3> points,
                       std::span<const double> parameters) {
  assert(points.size() == parameters.size());
  SpanWalk walk(curve);
  double bound = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double from = parameters[i - 1];
    const double length = parameters[i] - from;
    const Vec3 direction = (points[i] - points[i - 1]) / length;
    const Piece piece = sample_piece(walk, from, parameters[i], points[i - 1], direction);
    bound = std::max(bound, piece_bound(piece, length / kSteps, direction, length));
  }
  return bound;
}

}  // namespace twin::geometry
