#include "nc_programs/generate/fair_curve.hpp"

#include <Eigen/Cholesky>

namespace twin::programs {
namespace {

constexpr int kDegree = 5;
constexpr double kEndWeight = 1e4;
constexpr int kGaussPerSpan = 3;  // exact for the degree-4 integrand |C'''|^2

std::vector<double> chord_parameters(const std::vector<Point2>& sketch) {
  std::vector<double> t{0.0};
  for (std::size_t i = 1; i < sketch.size(); ++i) {
    t.push_back(t.back() + (sketch[i] - sketch[i - 1]).norm());
  }
  return t;
}

/// Clamped knots with one span between neighbouring sketch points.
std::vector<double> clamped_knots(const std::vector<double>& t) {
  std::vector<double> knots(kDegree, t.front());
  knots.insert(knots.end(), t.begin(), t.end());
  knots.insert(knots.end(), kDegree, t.back());
  return knots;
}

/// Row of all basis values N_i(t), or of their third derivatives.
Eigen::RowVectorXd basis_row(const std::vector<double>& knots, double t, bool third) {
  const std::size_t n = knots.size() - kDegree - 1;
  Eigen::RowVectorXd row(static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i) {
    BSpline<1> one{kDegree, knots, std::vector<BSpline<1>::Point>(n, BSpline<1>::Point::Zero())};
    one.points[i][0] = 1.0;
    const BSpline<1> f = third ? one.derivative().derivative().derivative() : one;
    row[static_cast<Eigen::Index>(i)] = f.at(t)[0];
  }
  return row;
}

}  // namespace

FairCurve::FairCurve(const std::vector<Point2>& sketch, double lambda) {
  const std::vector<double> t = chord_parameters(sketch);
  const std::vector<double> knots = clamped_knots(t);
  const auto n = static_cast<Eigen::Index>(knots.size() - kDegree - 1);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, 2);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double w = (i == 0 || i + 1 == t.size()) ? kEndWeight : 1.0;
    const Eigen::RowVectorXd row = basis_row(knots, t[i], false);
    normal += w * row.transpose() * row;
    right += w * row.transpose() * sketch[i].transpose();
  }
  const double offset[kGaussPerSpan] = {-0.7745966692414834, 0.0, 0.7745966692414834};
  const double weight[kGaussPerSpan] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double half = 0.5 * (t[i] - t[i - 1]);
    for (int g = 0; g < kGaussPerSpan; ++g) {
      const Eigen::RowVectorXd row = basis_row(knots, t[i - 1] + half * (1.0 + offset[g]), true);
      normal += lambda * half * weight[g] * row.transpose() * row;
    }
  }
  const Eigen::MatrixXd solution = normal.ldlt().solve(right);
  curve_ = {kDegree, knots, {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    curve_.points.emplace_back(solution.row(i).transpose());
  }
  first_ = curve_.derivative();
  second_ = first_.derivative();
}

FairCurve FairCurve::scaled(double factor) const {
  FairCurve out;
  out.curve_ = curve_;
  for (Point2& p : out.curve_.points) {
    p *= factor;
  }
  out.first_ = out.curve_.derivative();
  out.second_ = out.first_.derivative();
  return out;
}

Frame FairCurve::at(double t) const {
  const Point2 d = first_.at(t);
  const Point2 dd = second_.at(t);
  const double v = d.norm();
  return {curve_.at(t), d / v, (d.x() * dd.y() - d.y() * dd.x()) / (v * v * v)};
}

}  // namespace twin::programs
