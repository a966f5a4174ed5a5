#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>

namespace twin::studies::identify {

/// Residuals r(u) of a point u of the unit cube; called from several threads at a time.
using Residuals = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct LeastSquaresOptions {
  int iterations = 30;       ///< at most
  double difference = 1e-4;  ///< step of the finite differences, of the unit cube
  double tolerance = 1e-5;   ///< ends when an iteration gains a smaller share of the cost
  const std::atomic<bool>* stop = nullptr;  ///< set to end early
};

/// Where the sum of squares is least, and the derivatives there.
struct LeastSquaresFit {
  Eigen::VectorXd x;         ///< in the unit cube
  Eigen::VectorXd residual;  ///< r(x)
  double cost = 0.0;         ///< |r|^2
};

/// Minimises |r(u)|^2 on the unit cube [0, 1]^n from a start in it.
///
/// Levenberg-Marquardt: the step d solves (J^T J + mu diag(J^T J)) d = -J^T r, with mu smaller
/// after a gain and larger after a loss. Coordinates at a bound that the gradient pushes outwards
/// stand still for an iteration; steps are cut to the cube.
LeastSquaresFit least_squares(const Residuals& residuals, const Eigen::VectorXd& start,
                              const LeastSquaresOptions& options = {});

/// Derivatives J_ij = dr_i / du_j by differences, inwards at a bound; columns in parallel.
Eigen::MatrixXd jacobian(const Residuals& residuals, const Eigen::VectorXd& x,
                         const Eigen::VectorXd& residual, double difference);

/// The same by central differences where both sides are inside: twice the work, and what cancels
/// between columns cancels.
Eigen::MatrixXd central_jacobian(const Residuals& residuals, const Eigen::VectorXd& x,
                                 double difference);

/// Covariance of a least-squares estimate whose residuals are alike within blocks of rows.
///
/// With the scores s_b = sum over block b of J_k r_k,
///   C = (J^T J)^-1 (sum_b s_b s_b^T) (J^T J)^-1,
/// which stays right when residuals are correlated over less than a block [Liang & Zeger 1986]. A
/// variance is never less than that of uncorrelated residuals, s^2 (J^T J)^-1, and very large in
/// directions that J does not see.
/// @param block  rows in a block
Eigen::MatrixXd block_covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                                 Eigen::Index block);

/// (J^T J)^-1, with columns scaled to one size first.
Eigen::MatrixXd normal_inverse(const Eigen::MatrixXd& jacobian);

}  // namespace twin::studies::identify
