#include "studies/convert/uniform_refit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/linear_algebra.hpp"
#include "geometry/nurbs/basis.hpp"

namespace twin::studies::convert {
namespace {

constexpr int kDegree = 3;
constexpr int kPerSpan = 8;
constexpr double kSame = 1e-9;  // of the mean distance of knots

std::vector<double> uniform_knots(double begin, double end, int spans) {
  std::vector<double> knots(kDegree + 1, begin);
  for (int i = 1; i < spans; ++i) {
    knots.push_back(begin + (end - begin) * i / spans);
  }
  knots.insert(knots.end(), kDegree + 1, end);
  return knots;
}

/// First three control points of a clamped cubic from C, C', C'' at its beginning, where the first
/// spans have length h and the sign is -1 for the other end:
///   C' = 3 (P1 - P0) / h,   C'' = 6 / h^2 ((P2 - P1) / 2 - (P1 - P0)).
std::array<Vec3, 3> end_points(const geometry::Derivatives& at, double h, double sign) {
  const Vec3 first = (sign * h / 3.0) * at.first;
  const Vec3 second = 2.0 * (h * h / 6.0 * at.second + first);
  return {at.position, at.position + first, at.position + first + second};
}

/// The curve with a given number of spans.
std::optional<geometry::Curve> fit(const geometry::Curve& curve, int spans, double& distance) {
  const double begin = curve.u_min();
  const double h = (curve.u_max() - begin) / spans;
  std::vector<double> knots = uniform_knots(begin, curve.u_max(), spans);
  const auto n = static_cast<Eigen::Index>(spans) + kDegree;
  Eigen::MatrixX3d points = Eigen::MatrixX3d::Zero(n, 3);
  const auto first = end_points(curve.derivatives(begin), h, 1.0);
  const auto last = end_points(curve.derivatives(curve.u_max()), h, -1.0);
  for (Eigen::Index i = 0; i < 3; ++i) {
    points.row(i) = first[static_cast<std::size_t>(i)].transpose();
    points.row(n - 1 - i) = last[static_cast<std::size_t>(i)].transpose();
  }
  const Eigen::Index samples = Eigen::Index{kPerSpan} * spans;
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(samples, n);
  Eigen::MatrixX3d wanted(samples, 3);
  for (Eigen::Index k = 0; k < samples; ++k) {
    const double u = begin + h * (static_cast<double>(k) + 0.5) / kPerSpan;
    const int span = geometry::find_span(kDegree, knots, u, -1);
    const auto values = geometry::evaluate_basis<kDegree>(knots.data() + span, u);
    for (int j = 0; j <= kDegree; ++j) {
      basis(k, span - kDegree + j) = values.n[static_cast<std::size_t>(j)];
    }
    wanted.row(k) = curve.position(u).transpose();
  }
  if (const Eigen::Index free = n - 6; free > 0) {
    const Eigen::MatrixXd part = basis.middleCols(3, free);
    const Eigen::MatrixXd rest = wanted - basis.lazyProduct(points);
    points.middleRows(3, free) =
        solve_symmetric(transposed_product(part, part), transposed_product(part, rest));
  }
  distance = (wanted - basis.lazyProduct(points)).rowwise().norm().maxCoeff();
  std::vector<Vec3> control;
  for (Eigen::Index i = 0; i < n; ++i) {
    control.emplace_back(points.row(i).transpose());
  }
  auto made = geometry::Curve::create(kDegree, std::move(knots), std::move(control));
  return made ? std::optional(std::move(*made)) : std::nullopt;
}

}  // namespace

bool has_uniform_knots(const geometry::Curve& curve) {
  const auto p = static_cast<std::size_t>(curve.degree());
  const std::vector<double>& u = curve.knots();
  const std::size_t spans = u.size() - 2 * p - 1;
  const double mean = (curve.u_max() - curve.u_min()) / static_cast<double>(spans);
  for (std::size_t i = 0; i < spans; ++i) {
    if (std::abs(u[p + i + 1] - u[p + i] - mean) > kSame * mean) {
      return false;
    }
  }
  return true;
}

std::optional<geometry::Curve> uniform_refit(const geometry::Curve& curve, double distance,
                                             int most) {
  for (int spans = 3; spans <= most; ++spans) {
    double apart = 0.0;
    auto fitted = fit(curve, spans, apart);
    if (fitted && apart <= distance) {
      return fitted;
    }
  }
  return std::nullopt;
}

}  // namespace twin::studies::convert
