#include "studies/search/cma_es.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>

#include "core/linear_algebra.hpp"

namespace twin::studies::search {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastEigenvalue = 1e-20;  // of C, which rounding could make negative
constexpr double kMostLogStep = 1.0;        // by which sigma changes in a generation

/// Folds a coordinate into [0, 1]: 1.1 is 0.9, -0.1 is 0.1.
double folded(double x) {
  const double turn = std::abs(std::remainder(x, 2.0));
  return std::isfinite(turn) ? turn : 0.5;
}

/// Normally distributed numbers by Box and Muller, the same with every standard library.
class NormalNumbers {
 public:
  NormalNumbers(std::uint32_t seed, std::uint64_t generation)
      : random_(seed + 0x9E3779B97F4A7C15ULL * (generation + 1)) {}
  double next() {
    const double u = (static_cast<double>(random_() >> 11U) + 1.0) * 0x1p-53;
    const double turn = static_cast<double>(random_() >> 11U) * 0x1p-53;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * turn);
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace

CmaState CmaEs::start(std::span<const double> mean, double step) {
  const auto n = static_cast<Index>(mean.size());
  return {Eigen::Map<const VectorXd>(mean.data(), n),
          step,
          MatrixXd::Identity(n, n),
          VectorXd::Zero(n),
          VectorXd::Zero(n),
          0};
}

CmaEs::CmaEs(CmaState state, std::size_t population, std::uint32_t seed)
    : state_(std::move(state)),
      seed_(seed),
      dimension_(state_.mean.size()),
      weights_(static_cast<Index>(population / 2)),
      points_(state_.mean.size(), static_cast<Index>(population)) {
  const auto parents = static_cast<double>(weights_.size());
  for (Index i = 0; i < weights_.size(); ++i) {
    weights_[i] = std::log(parents + 0.5) - std::log(static_cast<double>(i) + 1.0);
  }
  weights_ /= weights_.sum();
  effective_ = 1.0 / weights_.squaredNorm();
}

std::vector<std::vector<double>> CmaEs::ask() {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(state_.covariance);
  directions_ = eigen.eigenvectors();
  lengths_ = eigen.eigenvalues().cwiseMax(kLeastEigenvalue).cwiseSqrt();
  NormalNumbers normal(seed_, state_.generation);
  std::vector<std::vector<double>> inside;
  for (Index k = 0; k < points_.cols(); ++k) {
    VectorXd z(dimension_);
    std::ranges::generate(z, [&] { return normal.next(); });
    points_.col(k) = state_.mean + state_.step * directions_.lazyProduct(lengths_.cwiseProduct(z));
    std::vector<double>& point = inside.emplace_back();
    for (const double x : points_.col(k)) {
      point.push_back(folded(x));
    }
  }
  return inside;
}

void CmaEs::tell(std::span<const double> costs) {
  std::vector<Index> order(costs.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, {}, [&](Index k) { return costs[static_cast<std::size_t>(k)]; });
  const auto n = static_cast<double>(dimension_);
  MatrixXd steps(dimension_, weights_.size());  // y_i
  for (Index i = 0; i < weights_.size(); ++i) {
    steps.col(i) = (points_.col(order[static_cast<std::size_t>(i)]) - state_.mean) / state_.step;
  }
  const VectorXd mean_step = steps.lazyProduct(weights_);
  const VectorXd turned = directions_.transpose().lazyProduct(mean_step);
  const VectorXd white = directions_.lazyProduct(turned.cwiseQuotient(lengths_));

  const double c_sigma = (effective_ + 2.0) / (n + effective_ + 5.0);
  const double damping =
      1.0 + 2.0 * std::max(0.0, std::sqrt((effective_ - 1.0) / (n + 1.0)) - 1.0) + c_sigma;
  const double c_c = (4.0 + effective_ / n) / (n + 4.0 + 2.0 * effective_ / n);
  const double c_1 = 2.0 / ((n + 1.3) * (n + 1.3) + effective_);
  const double c_mu = std::min(1.0 - c_1, 2.0 * (effective_ - 2.0 + 1.0 / effective_) /
                                              ((n + 2.0) * (n + 2.0) + effective_));
  const double chi = std::sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));

  state_.mean += state_.step * mean_step;
  state_.step_path = (1.0 - c_sigma) * state_.step_path +
                     std::sqrt(c_sigma * (2.0 - c_sigma) * effective_) * white;
  const double length = state_.step_path.norm();
  const double settled =
      1.0 - std::pow(1.0 - c_sigma, 2.0 * (static_cast<double>(state_.generation) + 1.0));
  const double h = length / std::sqrt(settled) / chi < 1.4 + 2.0 / (n + 1.0) ? 1.0 : 0.0;
  state_.covariance_path = (1.0 - c_c) * state_.covariance_path +
                           h * std::sqrt(c_c * (2.0 - c_c) * effective_) * mean_step;
  const double lost = (1.0 - h) * c_1 * c_c * (2.0 - c_c);
  const VectorXd& path = state_.covariance_path;
  state_.covariance =
      (1.0 - c_1 - c_mu + lost) * state_.covariance + c_1 * path.lazyProduct(path.transpose()) +
      c_mu * transposed_product((steps * weights_.asDiagonal()).transpose(), steps.transpose());
  state_.covariance = (0.5 * (state_.covariance + state_.covariance.transpose())).eval();
  state_.step *= std::exp(std::min(c_sigma / damping * (length / chi - 1.0), kMostLogStep));
  ++state_.generation;
}

}  // namespace twin::studies::search
