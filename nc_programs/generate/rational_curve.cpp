#include "nc_programs/generate/rational_curve.hpp"

#include <algorithm>

namespace twin::programs {
namespace {

constexpr int kProbes = 15;

/// Does the chord from u = a to b stay within the limits? See linearise().
bool chord_fits(const RationalCurve& curve, double a, double b, double tolerance, double longest) {
  const Point2 p = curve.point(a);
  const Point2 d = curve.point(b) - p;
  const double length = d.norm();
  if (length > longest) {
    return false;
  }
  for (int i = 1; i <= kProbes; ++i) {
    const Point2 v = curve.point(a + (b - a) * i / (kProbes + 1)) - p;
    const double along = std::clamp(v.dot(d) / std::max(length * length, 1e-18), 0.0, 1.0);
    if ((v - along * d).norm() > tolerance) {
      return false;
    }
  }
  return true;
}

std::vector<double> greedy_parameters(const RationalCurve& curve, double tolerance,
                                      double longest) {
  const double end = curve.knots().back();
  std::vector<double> u{curve.knots().front()};
  double step = 1e-4;  // bracket; the last step is a good guess for the next
  while (u.back() < end) {
    const double a = u.back();
    while (!chord_fits(curve, a, a + step, tolerance, longest)) {
      step *= 0.5;
    }
    while (a + 2.0 * step < end && chord_fits(curve, a, a + 2.0 * step, tolerance, longest)) {
      step *= 2.0;
    }
    if (a + step >= end || chord_fits(curve, a, end, tolerance, longest)) {
      u.push_back(end);
      break;
    }
    double low = step;
    double high = std::min(2.0 * step, end - a);
    for (int i = 0; i < 12; ++i) {
      const double middle = 0.5 * (low + high);
      (chord_fits(curve, a, a + middle, tolerance, longest) ? low : high) = middle;
    }
    u.push_back(a + low);
    step = low;
  }
  return u;
}

}  // namespace

RationalCurve::RationalCurve(int degree, const std::vector<Point2>& points,
                             const std::vector<double>& weights, const std::vector<double>& knots) {
  curve_.degree = degree;
  curve_.knots = knots;
  for (std::size_t i = 0; i < points.size(); ++i) {
    curve_.points.emplace_back(weights[i] * points[i].x(), weights[i] * points[i].y(), weights[i]);
  }
  first_ = curve_.derivative();
  second_ = first_.derivative();
}

Point2 RationalCurve::point(double u) const {
  const auto h = curve_.at(u);
  return h.head<2>() / h.z();
}

double RationalCurve::speed(double u) const {
  const auto h = curve_.at(u);
  const auto d = first_.at(u);
  const Point2 c = h.head<2>() / h.z();
  return ((d.head<2>() - d.z() * c) / h.z()).norm();
}

Frame RationalCurve::at(double u) const {
  const auto h = curve_.at(u);
  const auto d = first_.at(u);
  const auto dd = second_.at(u);
  const Point2 c = h.head<2>() / h.z();
  const Point2 c1 = (d.head<2>() - d.z() * c) / h.z();
  const Point2 c2 = (dd.head<2>() - 2.0 * d.z() * c1 - dd.z() * c) / h.z();
  const double v = c1.norm();
  return {c, c1 / v, (c1.x() * c2.y() - c1.y() * c2.x()) / (v * v * v)};
}

std::vector<Point2> linearise(const RationalCurve& curve, double tolerance, double longest) {
  std::vector<double> best = greedy_parameters(curve, tolerance, longest);
  double low = 0.5 * tolerance;
  double high = tolerance;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    const std::vector<double> u = greedy_parameters(curve, middle, longest);
    if (u.size() <= best.size()) {
      best = u;
      high = middle;
    } else {
      low = middle;
    }
  }
  std::vector<Point2> out;
  out.reserve(best.size());
  for (const double u : best) {
    out.push_back(curve.point(u));
  }
  return out;
}

}  // namespace twin::programs
