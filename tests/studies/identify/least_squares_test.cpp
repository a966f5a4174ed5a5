#include "studies/identify/least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace twin::studies::identify {
namespace least_squares_test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd vector(std::initializer_list<double> values) {
  VectorXd result(static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

TEST(LeastSquares, FindsTheEndOfABentValley) {
  // Rosenbrock's valley in the unit cube, its end at (0.5, 0.5).
  const auto valley = [](const VectorXd& u) {
    const double x = 2.0 * u[0];
    const double y = 2.0 * u[1];
    return vector({10.0 * (y - x * x), 1.0 - x});
  };
  LeastSquaresOptions options;
  options.iterations = 200;
  const LeastSquaresFit fit = least_squares(valley, vector({0.05, 0.9}), options);
  EXPECT_NEAR(fit.x[0], 0.5, 1e-4);
  EXPECT_NEAR(fit.x[1], 0.5, 1e-4);
}

TEST(LeastSquares, StopsAtTheBoundAndGoesOnAlongIt) {
  const auto outside = [](const VectorXd& u) { return vector({u[0] - 1.5, u[1] - 0.3}); };
  const LeastSquaresFit fit = least_squares(outside, vector({0.5, 0.9}));
  EXPECT_DOUBLE_EQ(fit.x[0], 1.0);
  EXPECT_NEAR(fit.x[1], 0.3, 1e-6);
}

TEST(LeastSquares, CentralDifferencesAreExactForAParabola) {
  const auto parabola = [](const VectorXd& u) { return vector({u[0] * u[0], u[0] * u[1]}); };
  const MatrixXd j = central_jacobian(parabola, vector({0.3, 0.7}), 1e-2);
  EXPECT_NEAR(j(0, 0), 0.6, 1e-12);
  EXPECT_NEAR(j(0, 1), 0.0, 1e-12);
  EXPECT_NEAR(j(1, 0), 0.7, 1e-12);
  EXPECT_NEAR(j(1, 1), 0.3, 1e-12);
}

/// The mean of noise that is the same over `alike` rows has the variance alike / rows.
void expect_variance_of_mean(Index alike, Index block) {
  constexpr Index kRows = 20000;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  VectorXd residual(kRows);
  for (Index k = 0; k < kRows; k += alike) {
    residual.segment(k, alike).setConstant(normal(random));
  }
  residual.array() -= residual.mean();
  const MatrixXd j = MatrixXd::Ones(kRows, 1);
  const double expected = static_cast<double>(alike) / static_cast<double>(kRows);
  EXPECT_NEAR(block_covariance(j, residual, block)(0, 0), expected, 0.25 * expected);
}

TEST(BlockCovariance, IsThatOfTheMeanForNoiseWhiteOrCorrelated) {
  expect_variance_of_mean(1, 40);
  expect_variance_of_mean(20, 80);
}

TEST(BlockCovariance, ColumnsThatCannotBeToldApartOrDoNotShowHaveAHugeVariance) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  MatrixXd j(1000, 4);
  VectorXd residual(1000);
  for (Index k = 0; k < 1000; ++k) {
    j(k, 0) = normal(random);
    j(k, 1) = -3.0 * j(k, 0);
    j(k, 2) = normal(random);
    j(k, 3) = 0.0;
    residual[k] = normal(random);
  }
  const MatrixXd covariance = block_covariance(j, residual, 10);
  EXPECT_GT(covariance(0, 0), 1e6);
  EXPECT_GT(covariance(1, 1), 1e6);
  EXPECT_NEAR(covariance(2, 2), 1e-3, 5e-4);
  EXPECT_GT(covariance(3, 3), 1e6);
}

}  // namespace least_squares_test
}  // namespace twin::studies::identify
