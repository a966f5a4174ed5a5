#include "nc_programs/generate/outline.hpp"

#include <algorithm>
#include <cmath>

namespace twin::programs {
namespace {

constexpr double kTableStep = 0.01;  // [mm]

/// Length of the curve between two near parameters by Gauss-Legendre quadrature with three points
/// [mm].
double length_between(const FairCurve& curve, double a, double b) {
  const double m = 0.5 * (a + b);
  const double h = 0.5 * (b - a);
  const double g = 0.7745966692414834 * h;
  return h * (5.0 * curve.speed(m - g) + 8.0 * curve.speed(m) + 5.0 * curve.speed(m + g)) / 9.0;
}

}  // namespace

Outline::Outline(const std::vector<FairCurve>& curves, const RoundShape& shape) {
  const std::size_t n = curves.size();
  std::vector<Round> rounds;  // rounds[i] joins curve i to the next
  for (std::size_t i = 0; i < n; ++i) {
    rounds.push_back(round_corner(curves[i], curves[(i + 1) % n], shape));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double a = rounds[(i + n - 1) % n].meet;
    const double b = rounds[i].leave;
    const double rough = curves[i].speed(0.5 * (a + b)) * (b - a);
    const int steps = static_cast<int>(std::ceil(rough / kTableStep));
    const auto t = [&](int k) { return a + (b - a) * k / steps; };
    if (i == 0) {
      append(curves[i].at(a), 0.0);
    }
    curve_begin_.push_back(s_.back());
    for (int k = 1; k <= steps; ++k) {
      append(curves[i].at(t(k)), length_between(curves[i], t(k - 1), t(k)));
    }
    curve_end_.push_back(s_.back());
    const auto& frames = rounds[i].frames;
    const double ds = rounds[i].length / static_cast<double>(frames.size() - 1);
    for (std::size_t k = 1; k < frames.size(); ++k) {
      append(frames[k], ds);
    }
  }
  frames_.back() = frames_.front();
}

void Outline::append(const Frame& frame, double ds) {
  s_.push_back(s_.empty() ? 0.0 : s_.back() + ds);
  frames_.push_back(frame);
}

double Outline::at_curve(std::size_t i, double fraction) const {
  return curve_begin_[i] + fraction * (curve_end_[i] - curve_begin_[i]);
}

Frame Outline::at(double s) const {
  const auto above = std::upper_bound(s_.begin() + 1, s_.end() - 1, s);
  const auto k = static_cast<std::size_t>(above - s_.begin());
  const Frame& a = frames_[k - 1];
  const Frame& b = frames_[k];
  const double h = s_[k] - s_[k - 1];
  const double x = (s - s_[k - 1]) / h;
  const double y = 1.0 - x;
  const Point2 p = y * y * (1.0 + 2.0 * x) * a.point + x * x * (1.0 + 2.0 * y) * b.point +
                   x * y * h * (y * a.tangent - x * b.tangent);
  return {p, (y * a.tangent + x * b.tangent).normalized(), y * a.curvature + x * b.curvature};
}

}  // namespace twin::programs
