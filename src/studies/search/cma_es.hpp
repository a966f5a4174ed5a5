#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace twin::studies::search {

/// What a search by CMA-ES remembers from one generation to the next; all of it, so that it can be
/// written to a file and gone on with.
struct CmaState {
  Eigen::VectorXd mean;             ///< m of the normal distribution
  double step = 0.0;                ///< sigma
  Eigen::MatrixXd covariance;       ///< C
  Eigen::VectorXd step_path;        ///< p_sigma
  Eigen::VectorXd covariance_path;  ///< p_c
  std::uint64_t generation = 0;
};

/// CMA-ES by asking for a generation of points and telling their costs [Hansen 2006].
///
/// A generation of lambda points is drawn from a normal distribution,
///   x_k = m + sigma B D z_k,   C = B D^2 B^T,   z_k ~ N(0, I).                              (1)
/// With the better half, x_1 the best, and weights w_i falling as ln(mu + 1/2) - ln i, the steps
/// y_i = (x_i - m) / sigma and y = sum w_i y_i give
///   m <- m + sigma y
///   p_sigma <- (1 - c_sigma) p_sigma + sqrt(c_sigma (2 - c_sigma) mu_eff) C^(-1/2) y
///   p_c <- (1 - c_c) p_c + h sqrt(c_c (2 - c_c) mu_eff) y
///   C <- (1 - c_1 - c_mu) C + c_1 p_c p_c^T + c_mu sum w_i y_i y_i^T
///   sigma <- sigma exp((c_sigma / d_sigma) (|p_sigma| / chi_n - 1))
/// where h is 0 while p_sigma is long, and constants are Hansen's. Only the order of the costs
/// counts. The random numbers of a generation depend on the seed and on its number alone: a search
/// that goes on from a CmaState draws what it would have drawn.
///
/// The cube [0, 1]^n is all there is: a point outside is folded back into it, as by mirrors.
class CmaEs {
 public:
  /// @param population  lambda, at least 4  @param state  from start() or of an earlier search
  CmaEs(CmaState state, std::size_t population, std::uint32_t seed);
  /// The state before the first generation.
  static CmaState start(std::span<const double> mean, double step);

  /// Draws a generation. @returns its points inside the cube
  std::vector<std::vector<double>> ask();
  /// Learns from the costs of the points of the last ask().
  void tell(std::span<const double> costs);

  const CmaState& state() const noexcept { return state_; }

 private:
  CmaState state_;
  std::uint32_t seed_;
  Eigen::Index dimension_;      // n
  Eigen::VectorXd weights_;     // w_i
  double effective_ = 0.0;      // mu_eff
  Eigen::MatrixXd points_;      // x_k, not folded; one a column
  Eigen::MatrixXd directions_;  // B
  Eigen::VectorXd lengths_;     // D
};

}  // namespace twin::studies::search
