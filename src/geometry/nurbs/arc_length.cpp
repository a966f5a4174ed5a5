#include "geometry/nurbs/arc_length.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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
constexpr double kEvenShare = 0.5;  // of q_0 in Eq. (1)

/// R, the share of q_0 in Eq. (1), and the largest length of an interval with sparse samples [mm]; see the
/// class.
constexpr double kSparseRadius = 4.0;
constexpr double kSparseShare = 0.95;
constexpr double kSparseLength = 0.03;

/// Curvature of an interval that is straight [1/mm]: one sample is enough.
constexpr double kStraight = 1e-9;

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

/// q across the two halves of an interval: at x = (y - 1) / 2 and x = (y + 1) / 2, y = -1..1.
std::pair<Quartic, Quartic> halves_of(const Quartic& q) noexcept {
  const double even0 = q[0] + 0.25 * q[2] + 0.0625 * q[4];
  const double odd0 = 0.5 * q[1] + 0.125 * q[3];
  const double even1 = 0.5 * q[1] + 0.375 * q[3];
  const double odd1 = 0.5 * q[2] + 0.25 * q[4];
  const double even2 = 0.25 * q[2] + 0.375 * q[4];
  const double odd2 = 0.375 * q[3];
  const double even3 = 0.125 * q[3];
  const double odd3 = 0.25 * q[4];
  const double even4 = 0.0625 * q[4];
  return {{even0 - odd0, even1 - odd1, even2 - odd2, even3 - odd3, even4},
          {even0 + odd0, even1 + odd1, even2 + odd2, even3 + odd3, even4}};
}

/// Whether q varies little enough over an interval, Eq. (1) with a radius R, by a share of q_0.
bool is_smooth(const Quartic& q, double radius, double share) noexcept {
  double sum = 0.0;
  for (std::size_t k = 4; k >= 1; --k) {
    sum = (sum + std::abs(q[k])) * radius;
  }
  return sum <= share * q[0];
}

/// Whether an interval is shorter than a length [mm], however fast the curve is on it.
bool is_shorter(const Quartic& q, double half, double length) noexcept {
  const double largest = q[0] + std::abs(q[1]) + std::abs(q[2]) + std::abs(q[3]) + q[4];
  return 4.0 * half * half * largest < length * length;
}

/// Curvature across an interval: C' x C'' = (d0 x d1 + 2 x (d0 x d2) + x^2 (d1 x d2)) / h.
class Bending {
 public:
  Bending(const Tangent& c, const Quartic& q, double half) noexcept
      : q_(q),
        a_(cross(c.d0, c.d1) / half),
        b_(cross(c.d0, c.d2) * (2.0 / half)),
        d_(cross(c.d1, c.d2) / half) {}

  double at(double x) const noexcept {
    const double square = value(q_, x);
    const double cubed = square * root(square);
    const double product = (a_ + x * (b_ + x * d_)).norm();
    return cubed > 0.0 ? product / cubed : 0.0;
  }

 private:
  const Quartic& q_;
  Vec3 a_, b_, d_;
};

/// Curvature at x = -1, -1/2, 0, 1/2.
void sample_cubic(const Tangent& c, const Quartic& q, double begin, double half,
                  const std::array<double, 4>& s, std::vector<CurvatureSample>& samples) {
  const Bending bending(c, q, half);
  for (int k = 0; k < 4; ++k) {
    samples.push_back(
        {begin + 0.5 * k * half, s[static_cast<std::size_t>(k)], bending.at(0.5 * k - 1.0)});
  }
}

/// Whether nowhere on an interval the curvature is above kStraight.
bool is_straight(const Tangent& c, const Quartic& q, double half) noexcept {
  const double product =
      cross(c.d0, c.d1).norm() + 2.0 * cross(c.d0, c.d2).norm() + cross(c.d1, c.d2).norm();
  const double least = q[0] - std::abs(q[1]) - std::abs(q[2]) - std::abs(q[3]) - q[4];
  return least > 0.0 && product <= kStraight * half * least * std::sqrt(least);
}

/// Whether the parabola through three values at equal steps rises or falls from end to end.
bool is_monotone(double a, double middle, double b) noexcept {
  const double first = middle - a;
  const double second = b - middle;
  return first * second > 0.0 && 3.0 * std::abs(first) >= std::abs(second) &&
         3.0 * std::abs(second) >= std::abs(first);
}

/// Where an interval whose curvature is largest at its begin is sampled, from x = -1 on, and the
/// weights of the five values of the speed for the arc length up to there. Each step is about as
/// long as the distance from the begin.
constexpr std::size_t kGraded = 4;
constexpr gauss::Values<kGraded> kGradedPlaces = {-0.875, -0.75, -0.5, 0.0};
constexpr std::array<gauss::Values<5>, kGraded> kGradedWeights = {
    gauss::partial_weights<5>(kGradedPlaces[0]), gauss::partial_weights<5>(kGradedPlaces[1]),
    gauss::partial_weights<5>(kGradedPlaces[2]), gauss::partial_weights<5>(kGradedPlaces[3])};

}  // namespace

/// The state of build(): one span after the other, halved where needed.
struct ArcLength::Builder {
  ArcLength& table;
  const Curve& curve;
  std::vector<CurvatureSample>* samples;
  Sampling sampling;
  double tolerance = kLengthTolerance;  // of a curve that is no cubic polynomial [mm]
  int halvings = 0;                     // left to it
  double known_at = 0.0;                // place within a span, and the curvature there
  double known = 0.0;

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

  /// Adds an interval of a cubic, divided where needed.
  /// @param q  |C'|^2 across it
  void add_cubic(const SpanCubic& cubic, double begin, double half, const Quartic& q, int depth) {
    if (sampling == Sampling::kSparse && depth > 0 && add_sparse(cubic, begin, half, q)) {
      return;
    }
    if (!is_smooth(q, kRadius, kEvenShare) && !is_shorter(q, half, kLengthTolerance) &&
        depth < kMaxDepth) {
      const auto [left, right] = sampling == Sampling::kSparse
                                     ? halves_of(q)
                                     : std::pair{square_on(cubic, begin, 0.5 * half),
                                                 square_on(cubic, begin + half, 0.5 * half)};
      add_cubic(cubic, begin, 0.5 * half, left, depth + 1);
      add_cubic(cubic, begin + half, 0.5 * half, right, depth + 1);
      return;
    }
    const double from = table.length_;
    const std::array<double, 4> s = append(begin, half, q, speeds_of(q));
    if (samples == nullptr) {
      return;
    }
    const Tangent tangent(cubic, begin + half - cubic.begin, half);
    if (sampling == Sampling::kSparse && is_straight(tangent, q, half)) {
      samples->push_back({begin, from, 0.0});
    } else {
      sample_cubic(tangent, q, begin, half, s, *samples);
    }
  }

  void add_cubic(const SpanCubic& cubic, double begin, double half) {
    add_cubic(cubic, begin, half, square_on(cubic, begin, half), 0);
  }

  /// |C'|^2 across an interval.
  static Quartic square_on(const SpanCubic& cubic, double begin, double half) noexcept {
    return Tangent(cubic, begin + half - cubic.begin, half).square();
  }

  static gauss::Values<5> speeds_of(const Quartic& q) noexcept {
    gauss::Values<5> speeds;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      speeds[i] = root(value(q, FivePoints::kNodes[i]));
    }
    return speeds;
  }

  /// Adds a short interval on which the curvature rises or falls, with few samples. At the end of
  /// the span where it is largest they are close.
  /// @returns false, with nothing done, where it is none
  bool add_sparse(const SpanCubic& cubic, double begin, double half, const Quartic& q) {
    if (!is_smooth(q, kSparseRadius, kSparseShare) || !is_shorter(q, half, kSparseLength)) {
      return false;
    }
    const Bending bending({cubic, begin + half - cubic.begin, half}, q, half);
    const double first = begin > cubic.begin && begin == known_at ? known : bending.at(-1.0);
    const double last = bending.at(1.0);
    known_at = begin + 2.0 * half;
    known = last;
    const double centre = bending.at(0.0);
    if (!is_monotone(first, centre, last)) {
      return false;
    }
    const gauss::Values<5> speeds = speeds_of(q);
    const double s = table.length_;
    table.intervals_.push_back({begin, half, s, q});
    table.length_ += half * gauss::weighted_sum(FivePoints::kWeights, speeds);
    samples->push_back({begin, s, first});
    const bool falls = first > last;
    if (falls ? begin > cubic.begin : begin + 2.5 * half < cubic.end) {
      samples->push_back({begin + half,
                          s + half * gauss::weighted_sum(FivePoints::kQuarterWeights[1], speeds),
                          centre});
      return true;
    }
    for (std::size_t i = 0; i < kGraded; ++i) {
      const std::size_t k = falls ? i : kGraded - 1 - i;
      const double x = falls ? kGradedPlaces[k] : -kGradedPlaces[k];
      const double part =
          half * (falls ? gauss::weighted_sum(kGradedWeights[k], speeds)
                        : gauss::weighted_sum(kGradedWeights[k], gauss::reversed(speeds)));
      samples->push_back(
          {begin + (1.0 + x) * half, falls ? s + part : table.length_ - part, bending.at(x)});
    }
    return true;
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

void ArcLength::build(const Curve& curve, std::vector<CurvatureSample>* samples,
                      Sampling sampling) {
  intervals_.clear();
  length_ = 0.0;
  is_cubic_ = curve.degree() == 3 && !curve.is_rational();
  if (samples != nullptr) {
    samples->clear();
  }
  Builder builder{*this, curve, samples, samples != nullptr ? sampling : Sampling::kEven};
  const std::vector<double>& u = curve.knots();
  const int end = static_cast<int>(u.size()) - curve.degree() - 1;
  for (const Vec3& point : curve.control_points()) {
    builder.tolerance = std::max(builder.tolerance, kRounding * point.cwiseAbs().maxCoeff());
  }
  builder.halvings = kHalvings * end + kMoreHalvings;
  intervals_.reserve(2 * static_cast<std::size_t>(end));
  if (samples != nullptr) {
    samples->reserve(4 * static_cast<std::size_t>(end));
  }
  for (int span = curve.degree(); span < end; ++span) {
    const double half = 0.5 * (u[span + 1] - u[span]);
    if (!(half > 0.0)) {
      continue;
    }
    if (is_cubic_) {
      builder.add_cubic(span_cubic(curve, span), u[span], half);
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
