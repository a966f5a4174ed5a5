#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>

namespace twin::studies::identify {

/// Computes the residuals r(u) at a point u of the unit cube. Several threads call it at a time.
using Residuals = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct LeastSquaresOptions {
  int iterations = 30;       ///< largest number of iterations
  double difference = 1e-4;  ///< step of the finite differences, as a share of the unit cube [-]
  double tolerance = 1e-5;   ///< ends when an iteration lowers the cost by less than this share [-]
  int reuses = 4;            ///< steps by derivatives that are brought up to date, at most
  const std::atomic<bool>* stop = nullptr;  ///< set by the caller to end early; may be null
};

/// The point at which the sum of squares is smallest.
struct LeastSquaresFit {
  Eigen::VectorXd x;         ///< the point, in the unit cube
  Eigen::VectorXd residual;  ///< r(x)
  double cost = 0.0;         ///< |r|^2
};

/// Minimises |r(u)|^2 on the unit cube [0, 1]^n from a start in it.
///
/// The method is Levenberg-Marquardt: the step d solves (J^T J + mu diag(J^T J)) d = -J^T r, where
/// mu becomes smaller after a step that lowers the cost and larger after one that does not. Steps
/// are clamped to the cube. After a step that gained, J is used again, with what the residual changed
/// by along the step [Broyden 1965]: that costs one residual in place of one a coordinate. A coordinate that is at a bound and would leave the cube is held for
/// one iteration.
LeastSquaresFit least_squares(const Residuals& residuals, const Eigen::VectorXd& start,
                              const LeastSquaresOptions& options = {});

/// Derivatives J_ij = dr_i / du_j by one-sided differences, which point inwards at a bound. The
/// columns are computed in parallel.
/// @param residual    r(x)
/// @param difference  step in u [-]
Eigen::MatrixXd jacobian(const Residuals& residuals, const Eigen::VectorXd& x,
                         const Eigen::VectorXd& residual, double difference);

/// The same by central differences, where both sides are inside the cube. It is twice the work. In
/// return, effects of two parameters that cancel each other also cancel in their columns.
Eigen::MatrixXd central_jacobian(const Residuals& residuals, const Eigen::VectorXd& x,
                                 double difference);

/// Covariance of a least-squares estimate whose residuals are alike within blocks of rows.
///
/// With the scores s_b = sum over block b of J_k r_k,
///   C = (J^T J)^-1 (sum_b s_b s_b^T) (J^T J)^-1,
/// which remains correct if residuals are correlated over less than a block [Liang & Zeger 1986].
/// No variance is smaller than that of uncorrelated residuals, s^2 (J^T J)^-1. Directions in which
/// the residuals do not change get a very large variance.
/// @param block  number of rows in a block
Eigen::MatrixXd block_covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                                 Eigen::Index block);

/// (J^T J)^-1. For accuracy the columns of J are scaled to the same length first.
Eigen::MatrixXd normal_inverse(const Eigen::MatrixXd& jacobian);

}  // namespace twin::studies::identify
