#include "nc_programs/generate/rounding.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace twin::programs {
namespace {

constexpr int kSteps = 400;

double smooth_step(double x) {
  const double c = std::min(std::max(x, 0.0), 1.0);
  return c * c * c * (c * (6.0 * c - 15.0) + 10.0);
}

double cross(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Curvature of the round at u [1/mm]; see the class description for the symbols.
double curvature_at(double u, double length, double from, double to, double peak, double d) {
  const double w = smooth_step(u / d) * smooth_step((length - u) / d);
  const double q = smooth_step(u / length);
  return (1.0 - w) * ((1.0 - q) * from + q * to) + w * peak;
}

/// Integrates heading and place by Simpson's rule over kSteps steps.
std::vector<Frame> integrate(const Frame& start, double end_curvature, double length, double peak,
                             double d) {
  const double h = length / kSteps;
  const auto kappa = [&](double u) {
    return curvature_at(u, length, start.curvature, end_curvature, peak, d);
  };
  double heading = std::atan2(start.tangent.y(), start.tangent.x());
  const auto direction = [](double a) { return Point2(std::cos(a), std::sin(a)); };
  std::vector<Frame> out{start};
  for (int i = 0; i < kSteps; ++i) {
    const double u = i * h;
    const double k0 = kappa(u), k1 = kappa(u + 0.25 * h), k2 = kappa(u + 0.5 * h);
    const double k3 = kappa(u + 0.75 * h), k4 = kappa(u + h);
    const double middle = heading + h / 12.0 * (k0 + 4.0 * k1 + k2);
    const double end = middle + h / 12.0 * (k2 + 4.0 * k3 + k4);
    const Point2 step = h / 6.0 * (direction(heading) + 4.0 * direction(middle) + direction(end));
    out.push_back({out.back().point + step, direction(end), k4});
    heading = end;
  }
  return out;
}

}  // namespace

Round round_corner(const FairCurve& before, const FairCurve& after, const RoundShape& shape) {
  const Frame in = before.at(before.end());
  const Frame out = after.at(after.begin());
  const double turn = std::atan2(cross(in.tangent, out.tangent), in.tangent.dot(out.tangent));
  const double peak = turn > 0.0 ? shape.peak : -shape.peak;
  const double d = std::min(shape.transition, 0.7 * std::abs(turn) / shape.peak);
  // First guess: straight legs. The round turns by about peak (l - d) and its chord spans the
  // corner.
  double length = std::abs(turn) / shape.peak + d;
  const Frame line{Point2::Zero(), Point2::UnitX(), 0.0};
  const double chord = integrate(line, 0.0, length, peak, d).back().point.norm();
  const double cut = 0.5 * chord / std::cos(0.5 * turn);
  Eigen::Vector3d x(before.end() - cut / before.speed(before.end()),
                    after.begin() + cut / after.speed(after.begin()), length);
  const auto residual = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    const Frame a = before.at(v[0]);
    const Frame b = after.at(v[1]);
    const Frame e = integrate(a, b.curvature, v[2], peak, d).back();
    const Point2 gap = e.point - b.point;
    return {gap.x(), gap.y(), std::atan2(cross(b.tangent, e.tangent), b.tangent.dot(e.tangent))};
  };
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d r = residual(x);
    if (r.norm() < 1e-12) {
      break;
    }
    Eigen::Matrix3d jacobian;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = 1e-5 * Eigen::Vector3d::Unit(k);
      jacobian.col(k) = (residual(x + step) - residual(x - step)) / 2e-5;
    }
    x -= jacobian.partialPivLu().solve(r).cwiseMax(-0.5).cwiseMin(0.5);
  }
  if (!(residual(x).norm() < 1e-9) || x[0] <= before.begin() || x[1] >= after.end() ||
      x[2] < 2.0 * d) {
    throw std::runtime_error("no round fits the corner at " + std::to_string(in.point.x()) + ", " +
                             std::to_string(in.point.y()) + " mm");
  }
  return {x[0], x[1], x[2], integrate(before.at(x[0]), after.at(x[1]).curvature, x[2], peak, d)};
}

}  // namespace twin::programs
