#include "geometry/smoothing/corner_bump.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/smoothing/piecewise.hpp"

namespace twin::geometry {
namespace {

/// Coefficients of 1, t, t^2, t^3.
using Cubic = std::array<double, 4>;

/// f(z) = a_0 + a_1 z + a_2 z^2 + a_3 z^3 at z = z_0 + q t.
Cubic shifted(const Cubic& a, double z0, double q) noexcept {
  return {a[0] + z0 * (a[1] + z0 * (a[2] + z0 * a[3])),
          q * (a[1] + z0 * (2.0 * a[2] + 3.0 * z0 * a[3])), q * q * (a[2] + 3.0 * z0 * a[3]),
          q * q * q * a[3]};
}

void add(const Vec3& factor, const Cubic& f, geometry::SpanCubic& piece) noexcept {
  piece.c0 += f[0] * factor;
  piece.c1 += f[1] * factor;
  piece.c2 += f[2] * factor;
  piece.c3 += f[3] * factor;
}

/// g and k on a piece that has none of their places inside.
void add_to_piece(const CornerBump& bump, double centre, double h, geometry::SpanCubic& piece) {
  const double middle = 0.5 * (piece.begin + piece.end) - centre;
  const double sign = middle < 0.0 ? -1.0 : 1.0;
  const double z0 = (piece.begin - centre) / h;
  const double q = 1.0 / h;
  const Cubic outer = shifted({0.0, 0.0, 0.0, 1.0}, 1.0 - sign * z0, -sign * q);  // (1 - y)^3
  add((h / 6.0) * bump.turn, outer, piece);
  if (2.0 * std::abs(middle) > h) {
    add((sign * h * h / 36.0) * bump.bend, outer, piece);
  } else {
    add((h * h) * bump.bend, shifted({0.0, 1.0 / 12.0, -0.25 * sign, 7.0 / 36.0}, z0, q), piece);
  }
}

}  // namespace

double CornerBump::height(double width) const noexcept {
  return turn.norm() * width / 6.0 + bend.norm() * width * width / 120.0;
}

double CornerBump::width(double height) const noexcept {
  const double a = bend.norm() / 120.0;
  const double b = turn.norm() / 6.0;
  const double root = std::sqrt(b * b + 4.0 * a * height);
  return root + b > 0.0 ? 2.0 * height / (b + root) : std::numeric_limits<double>::infinity();
}

void add_bump(const CornerBump& bump, double centre, double width,
              std::vector<geometry::SpanCubic>& pieces) {
  if (bump.bend != Vec3::Zero()) {
    split_at(centre - 0.5 * width, pieces);
    split_at(centre + 0.5 * width, pieces);
  }
  for (geometry::SpanCubic& piece : pieces) {
    add_to_piece(bump, centre, width, piece);
  }
}

}  // namespace twin::geometry
