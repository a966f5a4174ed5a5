#include "studies/identify/least_squares.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"
#include "core/parallel_for.hpp"

namespace twin::studies::identify {
namespace {

constexpr double kFirstDamping = 1e-2;
constexpr double kMostDamping = 1e8;
constexpr double kLeastDamping = 1e-9;
constexpr double kLongestStep = 0.1;  // of a coordinate in one iteration
constexpr double kUnseen = 1e-14;     // share of the largest eigenvalue below which J sees nothing

constexpr double kTiny = 1e-100;
constexpr int kAllTries = 100;      // of dampings: all there are
constexpr double kGoodGain = 1e-4;  // of a step, after which they are used again

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Leaves out what stands at a bound and would go outwards.
void hold_at_bounds(const VectorXd& x, VectorXd& gradient, MatrixXd& normal) {
  for (Index i = 0; i < x.size(); ++i) {
    if ((x[i] <= 0.0 && gradient[i] > 0.0) || (x[i] >= 1.0 && gradient[i] < 0.0)) {
      gradient[i] = 0.0;
      normal.row(i).setZero();
      normal.col(i).setZero();
      normal(i, i) = 1.0;
    }
  }
}

bool is_stopped(const LeastSquaresOptions& options) {
  return options.stop != nullptr && options.stop->load(std::memory_order_relaxed);
}

/// Tries steps of growing damping until one gains, and brings J up to date by what the residual
/// changed by along the step s: J + (r' - r - J s) s^T / (s^T s) [Broyden 1965].
/// @param tries  steps at most
/// @returns the share of the cost that was gained
double improve(const Residuals& residuals, LeastSquaresFit& fit, MatrixXd& j, double& damping,
               int tries, const LeastSquaresOptions& options) {
  VectorXd gradient = transposed_product(j, fit.residual);
  MatrixXd normal = transposed_product(j, j);
  hold_at_bounds(fit.x, gradient, normal);
  for (; tries > 0 && damping < kMostDamping && !is_stopped(options); damping *= 4.0, --tries) {
    MatrixXd damped = normal;
    damped.diagonal() += damping * normal.diagonal();
    damped.diagonal().array() += 1e-12 * normal.diagonal().maxCoeff();
    VectorXd step = -solve_symmetric(damped, gradient);
    if (!step.allFinite()) {
      continue;
    }
    step *= std::min(1.0, kLongestStep / std::max(step.cwiseAbs().maxCoeff(), kTiny));
    const VectorXd x = (fit.x + step).cwiseMax(0.0).cwiseMin(1.0);
    const VectorXd residual = residuals(x);
    const double cost = residual.squaredNorm();
    if (std::isfinite(cost) && cost < fit.cost) {
      const double gain = (fit.cost - cost) / fit.cost;
      const VectorXd moved = x - fit.x;
      const VectorXd missed = residual - fit.residual - j * moved;
      j += missed * (moved / moved.squaredNorm()).transpose();
      fit = {x, residual, cost};
      damping = std::max(damping / 10.0, kLeastDamping);
      return gain;
    }
  }
  return 0.0;
}

}  // namespace

MatrixXd jacobian(const Residuals& residuals, const VectorXd& x, const VectorXd& residual,
                  double difference) {
  MatrixXd j(residual.size(), x.size());
  parallel_for(static_cast<std::size_t>(x.size()), [&](std::size_t column) {
    const auto i = static_cast<Index>(column);
    VectorXd moved = x;
    moved[i] += x[i] + difference <= 1.0 ? difference : -difference;
    j.col(i) = (residuals(moved) - residual) / (moved[i] - x[i]);
  });
  return j;
}

MatrixXd central_jacobian(const Residuals& residuals, const VectorXd& x, double difference) {
  MatrixXd j(residuals(x).size(), x.size());
  parallel_for(static_cast<std::size_t>(x.size()), [&](std::size_t column) {
    const auto i = static_cast<Index>(column);
    VectorXd above = x;
    VectorXd below = x;
    above[i] = std::min(x[i] + difference, 1.0);
    below[i] = std::max(x[i] - difference, 0.0);
    j.col(i) = (residuals(above) - residuals(below)) / (above[i] - below[i]);
  });
  return j;
}

LeastSquaresFit least_squares(const Residuals& residuals, const VectorXd& start,
                              const LeastSquaresOptions& options) {
  LeastSquaresFit fit;
  fit.x = start.cwiseMax(0.0).cwiseMin(1.0);
  fit.residual = residuals(fit.x);
  fit.cost = fit.residual.squaredNorm();
  if (fit.x.size() == 0 || !(fit.cost > 0.0)) {
    return fit;
  }
  double damping = kFirstDamping;
  for (int i = 0; i < options.iterations && !is_stopped(options); ++i) {
    MatrixXd j = jacobian(residuals, fit.x, fit.residual, options.difference);
    double gain = improve(residuals, fit, j, damping, kAllTries, options);
    if (gain < options.tolerance) {
      break;
    }
    // Steps by the same derivatives cost one residual each, new derivatives one a parameter.
    for (int k = 0; k < options.reuses && gain > kGoodGain; ++k) {
      gain = improve(residuals, fit, j, damping, 1, options);
    }
  }
  return fit;
}

MatrixXd block_covariance(const MatrixXd& jacobian, const VectorXd& residual, Index block) {
  const Index n = jacobian.cols();
  MatrixXd scores = MatrixXd::Zero(n, n);
  for (Index begin = 0; begin < jacobian.rows(); begin += block) {
    const Index rows = std::min(block, jacobian.rows() - begin);
    const VectorXd score =
        transposed_product(jacobian.middleRows(begin, rows), residual.segment(begin, rows));
    scores += score.lazyProduct(score.transpose());
  }
  const MatrixXd inverse = normal_inverse(jacobian);
  MatrixXd covariance = transposed_product(inverse, transposed_product(scores, inverse));
  const double variance =
      residual.squaredNorm() / static_cast<double>(std::max<Index>(residual.size() - n, 1));
  for (Index i = 0; i < n; ++i) {
    covariance(i, i) = std::max(covariance(i, i), variance * inverse(i, i));
  }
  return covariance;
}

MatrixXd normal_inverse(const MatrixXd& jacobian) {
  const VectorXd norm = jacobian.colwise().norm();
  const VectorXd size = norm.cwiseMax(kUnseen * norm.maxCoeff() + kTiny);
  const MatrixXd scaled = jacobian * size.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(transposed_product(scaled, scaled));
  const VectorXd values =
      eigen.eigenvalues().cwiseMax(kUnseen * eigen.eigenvalues().maxCoeff()).cwiseInverse();
  const MatrixXd right = eigen.eigenvectors().transpose() * size.cwiseInverse().asDiagonal();
  return transposed_product(right, values.asDiagonal() * right);
}

}  // namespace twin::studies::identify
