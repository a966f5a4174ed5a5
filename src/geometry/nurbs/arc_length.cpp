#include "geometry/nurbs/arc_length.hpp"

#include <algorithm>
#include <cmath>

#include "core/root.hpp"
#include "geometry/gauss_legendre.hpp"

namespace twin::geometry {
namespace {

constexpr double kLengthTolerance = 1e-10;  // of one interval [mm]
constexpr double kPlaceTolerance = 1e-10;   // of u_at [mm]
constexpr double kRounding = 1e-13;         // of the coordinates, seen in a length
constexpr int kMaxDepth = 40;               // halvings of one span

/// Halvings that a curve may need: so many per span on average, and so many more. They bound time
/// and memory for a curve with a cusp, at which no halving is enough.
constexpr int kHalvings = 32;
constexpr int kMoreHalvings = 2000;

/// R of Eq. (1). A larger R makes the quadrature more exact and needs shorter intervals: at R = 4
/// its error would be 3e-9 of an interval, at R = 16 below the rounding.
constexpr double kRadius = 8.0;

using FivePoints = gauss::Rule<5>;
using Quartic = std::array<double, 5>;

double value(const Quartic& q, double x) noexcept {
  return q[0] + x * (q[1] + x * (q[2] + x * (q[3] + x * q[4])));
}

double root(double square) noexcept { return std::sqrt(std::max(0.0, square)); }

/// C' = d0 + d1 x + d2 x^2 across an interval of half width h, x = (t - centre) / h; still per unit
/// of u.
struct Tangent {
  Vec3 d0, d1, d2;

  Tangent(const SpanCubic& c, double t, double h) noexcept
      : d0(c.c1 + t * (2.0 * c.c2 + (3.0 * t) * c.c3)),
        d1(h * (2.0 * c.c2 + (6.0 * t) * c.c3)),
        d2((3.0 * h * h) * c.c3) {}

  Quartic square() const noexcept {
    return {d0.squaredNorm(), 2.0 * d0.dot(d1), d1.squaredNorm() + 2.0 * d0.dot(d2),
            2.0 * d1.dot(d2), d2.squaredNorm()};
  }
};

/// Whether one application of the quadrature to sqrt(q) is good enough, Eqs. (1) and (2).
bool is_smooth(const Quartic& q, double half) noexcept {
  double sum = 0.0;
  for (std::size_t k = 4; k >= 1; --k) {
    sum = (sum + std::abs(q[k])) * kRadius;
  }
  const double largest = q[0] + std::abs(q[1]) + std::abs(q[2]) + std::abs(q[3]) + q[4];
  return sum <= 0.5 * q[0] || 2.0 * half * std::sqrt(largest) < kLengthTolerance;
}

/// Curvature at x = -1, -1/2, 0, 1/2: C' x C'' = (d0 x d1 + 2 x (d0 x d2) + x^2 (d1 x d2)) / h.
void sample_cubic(const Tangent& c, const Quartic& q, double begin, double half,
                  const std::array<double, 4>& s, std::vector<CurvatureSample>& samples) {
  const Vec3 a = cross(c.d0, c.d1) / half;
  const Vec3 b = cross(c.d0, c.d2) * (2.0 / half);
  const Vec3 d = cross(c.d1, c.d2) / half;
  for (int k = 0; k < 4; ++k) {
    const double x = 0.5 * k - 1.0;
    const double square = value(q, x);
    const double cubed = square * root(square);
    const double product = (a + x * (b + x * d)).norm();
    samples.push_back({begin + 0.5 * k * half, s[static_cast<std::size_t>(k)],
                       cubed > 0.0 ? product / cubed : 0.0});
  }
}

}  // namespace

/// The state of build(): one span after the other, halved where needed.
struct ArcLength::Builder {
  ArcLength& table;
  const Curve& curve;
  std::vector<CurvatureSample>* samples;
  double tolerance = kLengthTolerance;  // of a curve that is no cubic polynomial [mm]
  int halvings = 0;                     // left to it

  /// Adds an interval whose speeds at the nodes are known; returns arc lengths at its quarters.
  std::array<double, 4> append(double begin, double half, const Quartic& q,
                               const gauss::Values<5>& speeds) {
    const double s = table.length_;
    table.intervals_.push_back({begin, half, s, q});
    table.length_ += half * gauss::weighted_sum(FivePoints::kWeights, speeds);
    std::array<double, 4> quarters = {s, s, s, s};
    for (std::size_t k = 0; samples != nullptr && k < 3; ++k) {
      quarters[k + 1] += half * gauss::weighted_sum(FivePoints::kQuarterWeights[k], speeds);
    }
    return quarters;
  }

  void add_cubic(const SpanCubic& cubic, double begin, double half, int depth) {
    const Tangent tangent(cubic, begin + half - cubic.begin, half);
    const Quartic q = tangent.square();
    if (!is_smooth(q, half) && depth < kMaxDepth) {
      add_cubic(cubic, begin, 0.5 * half, depth + 1);
      add_cubic(cubic, begin + half, 0.5 * half, depth + 1);
      return;
    }
    gauss::Values<5> speeds;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      speeds[i] = root(value(q, FivePoints::kNodes[i]));
    }
    const std::array<double, 4> s = append(begin, half, q, speeds);
    if (samples != nullptr) {
      sample_cubic(tangent, q, begin, half, s, *samples);
    }
  }

  gauss::Values<5> speeds_on(int span, double begin, double half) const {
    gauss::Values<5> speeds;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      speeds[i] =
          curve.derivatives(begin + half * (1.0 + FivePoints::kNodes[i]), span).first.norm();
    }
    return speeds;
  }

  void add_any(int span, double begin, double half, const gauss::Values<5>& speeds, int depth) {
    const double quarter = 0.5 * half;
    const gauss::Values<5> left = speeds_on(span, begin, quarter);
    const gauss::Values<5> right = speeds_on(span, begin + half, quarter);
    const double whole = half * gauss::weighted_sum(FivePoints::kWeights, speeds);
    const double halves = quarter * (gauss::weighted_sum(FivePoints::kWeights, left) +
                                     gauss::weighted_sum(FivePoints::kWeights, right));
    if (std::abs(whole - halves) > tolerance && depth < kMaxDepth && halvings > 0) {
      --halvings;
      add_any(span, begin, quarter, left, depth + 1);
      add_any(span, begin + half, quarter, right, depth + 1);
      return;
    }
    const std::array<double, 4> s = append(begin, half, {}, speeds);
    for (std::size_t k = 0; samples != nullptr && k < 4; ++k) {
      const double u = begin + 0.5 * half * static_cast<double>(k);
      samples->push_back({u, s[k], curvature(curve.derivatives(u, span))});
    }
  }
};

void ArcLength::build(const Curve& curve, std::vector<CurvatureSample>* samples) {
  intervals_.clear();
  length_ = 0.0;
  is_cubic_ = curve.degree() == 3 && !curve.is_rational();
  if (samples != nullptr) {
    samples->clear();
  }
  Builder builder{*this, curve, samples};
  const std::vector<double>& u = curve.knots();
  const int end = static_cast<int>(u.size()) - curve.degree() - 1;
  for (const Vec3& point : curve.control_points()) {
    builder.tolerance = std::max(builder.tolerance, kRounding * point.cwiseAbs().maxCoeff());
  }
  builder.halvings = kHalvings * end + kMoreHalvings;
  for (int span = curve.degree(); span < end; ++span) {
    const double half = 0.5 * (u[span + 1] - u[span]);
    if (!(half > 0.0)) {
      continue;
    }
    if (is_cubic_) {
      builder.add_cubic(span_cubic(curve, span), u[span], half, 0);
    } else {
      builder.add_any(span, u[span], half, builder.speeds_on(span, u[span], half), 0);
    }
  }
  if (samples != nullptr) {
    samples->push_back({curve.u_max(), length_, curvature(curve.derivatives(curve.u_max()))});
  }
}

double ArcLength::speed(const Curve& curve, const Interval& interval, double x) const noexcept {
  return is_cubic_ ? root(value(interval.q, x))
                   : curve.derivatives(interval.begin + interval.half * (1.0 + x)).first.norm();
}

/// Arc length from the beginning of the interval to x [mm].
double ArcLength::partial(const Curve& curve, const Interval& interval, double x) const noexcept {
  const double scale = 0.5 * (1.0 + x);
  double sum = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    sum += FivePoints::kWeights[i] *
           speed(curve, interval, scale * (1.0 + FivePoints::kNodes[i]) - 1.0);
  }
  return scale * interval.half * sum;
}

double ArcLength::s_at(const Curve& curve, double u) const noexcept {
  if (!(u > curve.u_min())) {
    return 0.0;
  }
  if (u >= curve.u_max()) {
    return length_;
  }
  const auto above = std::upper_bound(intervals_.begin(), intervals_.end(), u,
                                      [](double at, const Interval& i) { return at < i.begin; });
  const Interval& interval = *(above - 1);
  return interval.s + partial(curve, interval, (u - interval.begin) / interval.half - 1.0);
}

double ArcLength::u_at(const Curve& curve, double s, double u_guess) const noexcept {
  if (!(s > 0.0)) {
    return curve.u_min();
  }
  if (s >= length_) {
    return curve.u_max();
  }
  const auto above = std::upper_bound(intervals_.begin(), intervals_.end(), s,
                                      [](double at, const Interval& i) { return at < i.s; });
  const Interval& interval = *(above - 1);
  const double interval_length = (above == intervals_.end() ? length_ : above->s) - interval.s;
  double x = (u_guess - interval.begin) / interval.half - 1.0;
  if (!(x >= -1.0 && x <= 1.0)) {
    x = 2.0 * (s - interval.s) / interval_length - 1.0;
  }
  const auto error_at = [&](double at) {
    return ValueAndSlope{interval.s + partial(curve, interval, at) - s,
                         speed(curve, interval, at) * interval.half};
  };
  // A Newton step leaves |f''| / (2 |f'|) step^2, and the speed varies by less than itself over an
  // interval.
  const double last_step = std::sqrt(0.1 * kPlaceTolerance / interval_length);
  x = bracketed_newton(error_at, -1.0, 1.0, x, {0.01 * kPlaceTolerance, last_step}).x;
  return interval.begin + interval.half * (1.0 + x);
}

}  // namespace twin::geometry
