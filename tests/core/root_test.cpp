#include "core/root.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace twin {
namespace root_test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr NewtonTolerance kTight{-1.0, 1e-15, 1e-15};

TEST(BracketedNewton, FindsTheSquareRootOfTwo) {
  const auto f = [](double x) { return ValueAndSlope{x * x - 2.0, 2.0 * x}; };
  EXPECT_NEAR(bracketed_newton(f, 0.0, 2.0, 1.0, kTight).x, std::numbers::sqrt2, 1e-15);
}

TEST(BracketedNewton, FindsTheAngleOfKeplersEquation) {
  for (const double eccentricity : {0.0, 0.3, 0.9, 0.999}) {
    for (const double angle : {1e-6, 0.1, 1.0, 2.0, 3.1}) {
      const double mean = angle - eccentricity * std::sin(angle);
      const auto f = [&](double x) {
        return ValueAndSlope{x - eccentricity * std::sin(x) - mean,
                             1.0 - eccentricity * std::cos(x)};
      };
      const double x = bracketed_newton(f, 0.0, std::numbers::pi, 1.5, kTight).x;
      EXPECT_NEAR(x, angle, 1e-14 / (1.0 - eccentricity * std::cos(angle))) << eccentricity;
    }
  }
}

TEST(BracketedNewton, ConvergesWherePlainNewtonDiverges) {
  // From |x| > 1.39 each plain Newton step of atan goes farther out.
  const auto f = [](double x) {
    return ValueAndSlope{std::atan(x - 3.0), 1.0 / (1.0 + (x - 3.0) * (x - 3.0))};
  };
  EXPECT_NEAR(bracketed_newton(f, -100.0, 100.0, 90.0, kTight).x, 3.0, 1e-14);
}

TEST(BracketedNewton, BisectsWhereTheSlopeIsOfNoUse) {
  for (const double slope : {0.0, -1.0, kNaN, std::numeric_limits<double>::infinity()}) {
    const auto f = [&](double x) { return ValueAndSlope{x * x * x - 8.0, slope}; };
    EXPECT_NEAR(bracketed_newton(f, 0.0, 7.0, 1.0, kTight).x, 2.0, 2e-15) << slope;
  }
}

TEST(BracketedNewton, KeepsTheRootInsideTheBracketAndNeverLeavesIt) {
  double low = 0.0;
  double high = 10.0;
  const auto f = [&](double x) {
    EXPECT_GE(x, low);
    EXPECT_LE(x, high);
    const double value = std::pow(x, 5) - 100.0;
    (value > 0.0 ? high : low) = x;
    return ValueAndSlope{value, 5.0 * std::pow(x, 4)};
  };
  const NewtonRoot root = bracketed_newton(f, low, high, 0.1, {1e-10});
  EXPECT_TRUE(root.is_met);
  EXPECT_LE(root.low, std::pow(100.0, 0.2));
  EXPECT_GE(root.high, std::pow(100.0, 0.2));
}

TEST(BracketedNewton, EndsAtAnArgumentWhoseValueIsWithinTheTolerance) {
  int calls = 0;
  const auto f = [&](double x) {
    ++calls;
    return ValueAndSlope{x - 0.25, 1.0};
  };
  const NewtonRoot root = bracketed_newton(f, 0.0, 1.0, 0.2501, {1e-3});
  EXPECT_TRUE(root.is_met);
  EXPECT_EQ(root.x, 0.2501);
  EXPECT_EQ(calls, 1);
}

TEST(BracketedNewton, EvaluatesNoMoreOftenThanItIsAllowed) {
  int calls = 0;
  const auto f = [&](double) {
    ++calls;
    return ValueAndSlope{kNaN, kNaN};
  };
  const NewtonRoot root = bracketed_newton(f, 0.0, 1.0, 0.5, {-1.0, 0.0, 0.0, 17});
  EXPECT_FALSE(root.is_met);
  EXPECT_EQ(calls, 17);
}

TEST(RootFromBelow, FindsTheCubeRootFromBelow) {
  for (const int bisect_every : {3, 4}) {
    const auto f = [](double x) { return x * x * x - 5.0; };
    const double x =
        root_from_below(f, 0.0, f(0.0), 10.0, f(10.0), {0.0, 1e-15, 200, bisect_every});
    EXPECT_LE(f(x), 0.0);
    EXPECT_NEAR(x, std::cbrt(5.0), 5e-15);
  }
}

TEST(RootFromBelow, EndsOnceTheValueIsJustBelowZero) {
  const auto f = [](double x) { return std::exp(x) - 2.0; };
  const double x = root_from_below(f, 0.0, f(0.0), 5.0, f(5.0), {1e-6});
  EXPECT_LE(f(x), 0.0);
  EXPECT_GT(f(x), -1e-6);
}

TEST(RootFromBelow, BracketsAJumpFromBelow) {
  const auto f = [](double x) { return x < 0.7 ? -1.0 : 1e6; };
  const double x = root_from_below(f, 0.0, -1.0, 1.0, 1e6, {0.0, 1e-14, 300, 3});
  EXPECT_LT(x, 0.7);
  EXPECT_NEAR(x, 0.7, 1e-13);
}

TEST(RootFromBelow, EvaluatesNoMoreOftenThanItIsAllowed) {
  int calls = 0;
  const auto f = [&](double) {
    ++calls;
    return -1.0;
  };
  root_from_below(f, 0.0, -1.0, 1.0, 1.0, {0.0, 0.0, 7, 3});
  EXPECT_EQ(calls, 7);
}

}  // namespace root_test
}  // namespace twin
