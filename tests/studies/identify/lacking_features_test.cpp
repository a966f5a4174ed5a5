#include "studies/identify/lacking_features.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/linear_algebra.hpp"
#include "studies/identify/least_squares.hpp"

/// Truth is the textbook bias of a variable that a linear regression leaves out.
namespace twin::studies::identify {
namespace lacking_features_test {

constexpr Eigen::Index kRows = 2000;
constexpr Eigen::Index kBlock = 50;
constexpr double kUsual = 2.0;

/// Measured less model after a fit of J alone to J p + noise - D a.
struct Fit {
  Eigen::VectorXd found;
  Eigen::VectorXd residual;
};

class Regression {
 public:
  Regression() : j(kRows, 2), signature(kRows, 1) {
    for (Eigen::Index k = 0; k < kRows; ++k) {
      const double t = static_cast<double>(k) * 0.01;
      j(k, 0) = std::sin(t);
      j(k, 1) = std::cos(3.0 * t);
      signature(k, 0) = 0.7 * std::sin(t) + 0.4 * std::sin(5.0 * t);
    }
  }
  Fit fit(double strength, double noise) {
    Eigen::VectorXd data = -signature.col(0) * strength;
    std::normal_distribution<double> normal(0.0, noise);
    for (double& value : data) {
      value += normal(random_);
    }
    Fit fit;
    fit.found = -(normal_inverse(j) * transposed_product(j, data));
    fit.residual = data + j * fit.found;
    return fit;
  }

  Eigen::MatrixXd j;
  Eigen::MatrixXd signature;

 private:
  std::mt19937 random_{3};
};

TEST(LackingFeatures, DoubtIsTheBiasOfWhatWasLeftOut) {
  Regression regression;
  const Fit fit = regression.fit(1.5, 0.01);  // the true parameters are 0
  const FeatureDoubt doubt =
      feature_doubt(regression.j, fit.residual, regression.signature, kUsual, kBlock);
  EXPECT_NEAR(std::abs(fit.found[0]), 0.7 * 1.5, 0.01);
  EXPECT_NEAR(doubt.spread[0], std::abs(fit.found[0]), 0.02);
  EXPECT_LT(doubt.spread[1], 0.04);
  EXPECT_GT(doubt.share, 0.99);
}

TEST(LackingFeatures, WhatTheDataExcludeMakesNoDoubt) {
  Regression regression;
  const Fit fit = regression.fit(0.0, 0.01);
  const FeatureDoubt doubt =
      feature_doubt(regression.j, fit.residual, regression.signature, kUsual, kBlock);
  EXPECT_LT(doubt.spread[0], 0.04);
  EXPECT_LT(doubt.share, 0.05);
}

// A late encoder and a late output look the same: no residual tells how much of each there is.
TEST(LackingFeatures, WhatAParameterDoesAsWellIsNotTakenForAbsent) {
  Regression regression;
  regression.signature.col(0) = regression.j.col(1);
  const Fit fit = regression.fit(1.5, 0.01);
  const FeatureDoubt doubt =
      feature_doubt(regression.j, fit.residual, regression.signature, kUsual, kBlock);
  EXPECT_NEAR(doubt.spread[1], kUsual, 0.01);
}

// A sampling shorter than a physics step is none.
TEST(LackingFeatures, AFeatureWithoutEffectMakesNoDoubt) {
  Regression regression;
  const Fit fit = regression.fit(0.0, 0.01);
  regression.signature.setZero();
  const FeatureDoubt doubt =
      feature_doubt(regression.j, fit.residual, regression.signature, kUsual, kBlock);
  EXPECT_EQ(doubt.spread.norm(), 0.0);
  EXPECT_EQ(doubt.share, 0.0);
}

TEST(LackingFeatures, EachChangesTheMachine) {
  config::MachineFile machine;
  for (const LackingFeature& feature : lacking_features(machine, hal::kY, false)) {
    EXPECT_FALSE(feature.machines.empty()) << feature.name;
    EXPECT_FALSE(feature.name.empty());
  }
}

}  // namespace lacking_features_test
}  // namespace twin::studies::identify
