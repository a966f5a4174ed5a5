#include "studies/search/minimise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/parallel_for.hpp"

namespace twin::studies::search {
namespace minimise_test {

/// A bent valley with its only minimum, 0, where every coordinate is 0.6 (Rosenbrock's function).
double valley(std::span<const double> x) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double a = x[i] / 0.6;
    const double b = x[i + 1] / 0.6;
    sum += 100.0 * (b - a * a) * (b - a * a) + (1.0 - a) * (1.0 - a);
  }
  return sum;
}

MinimiseOptions from(std::vector<double> start, std::size_t evaluations) {
  MinimiseOptions options;
  options.start = std::move(start);
  options.evaluations = evaluations;
  return options;
}

TEST(Minimise, FindsTheEndOfABentValley) {
  const Minimum found = minimise(valley, from({0.1, 0.9, 0.1, 0.9}, 8000));
  for (const double x : found.x) {
    EXPECT_NEAR(x, 0.6, 1e-4);
  }
  EXPECT_LE(found.evaluations, 8001U);
}

TEST(Minimise, FindsAMinimumOnTheBound) {
  const auto slope = [](std::span<const double> x) { return x[0] - 2.0 * x[1] + x[2]; };
  const Minimum found = minimise(slope, from({0.5, 0.5, 0.5}, 2000));
  EXPECT_NEAR(found.cost, -2.0, 1e-6);
  for (const double x : found.x) {
    EXPECT_GE(x, 0.0);
    EXPECT_LE(x, 1.0);
  }
}

TEST(Minimise, SameSeedSameResultWhateverTheNumberOfThreads) {
  const auto cost_with = [](unsigned threads) {
    return [threads](std::span<const double> x) {
      std::vector<double> part(x.size());
      parallel_for(
          x.size(), [&](std::size_t i) { part[i] = std::abs(x[i] - 0.1 * static_cast<double>(i)); },
          threads);
      double sum = 0.0;
      for (const double p : part) {
        sum += p;
      }
      return sum;
    };
  };
  MinimiseOptions options = from({0.9, 0.9, 0.9}, 500);
  const Minimum one = minimise(cost_with(1), options);
  const Minimum three = minimise(cost_with(3), options);
  EXPECT_EQ(one.x, three.x);
  EXPECT_EQ(one.evaluations, three.evaluations);
  options.seed = 2;
  EXPECT_NE(minimise(cost_with(1), options).x, one.x);
}

TEST(Minimise, IsNeverWorseThanItsStart) {
  const auto spike = [](std::span<const double> x) { return x[0] == 0.25 ? -1.0 : x[0]; };
  EXPECT_EQ(minimise(spike, from({0.25}, 300)).cost, -1.0);
}

TEST(Minimise, CostsThatAreNoNumbersAreAvoided) {
  const auto half = [](std::span<const double> x) {
    return x[0] > 0.5 ? std::numeric_limits<double>::quiet_NaN() : -x[0];
  };
  EXPECT_NEAR(minimise(half, from({0.1, 0.5}, 2000)).cost, -0.5, 1e-3);
}

TEST(Minimise, TheStopFlagEndsItWithTheBestSoFar) {
  std::atomic<bool> stop{false};
  int calls = 0;
  MinimiseOptions options = from({0.2, 0.2}, 100000);
  options.stop = &stop;
  const Minimum found = minimise(
      [&](std::span<const double> x) {
        stop = ++calls == 100;
        return valley(x);
      },
      options);
  EXPECT_TRUE(found.was_stopped);
  EXPECT_EQ(calls, 100);
  EXPECT_EQ(found.x.size(), 2U);
}

TEST(Minimise, ProgressGrowsToItsEndAndTheCostNeverRises) {
  double last_share = 0.0;
  double last_cost = std::numeric_limits<double>::max();
  MinimiseOptions options = from({0.1, 0.9}, 400);
  options.precision = 0.0;
  options.progress = [&](double share, double cost) {
    EXPECT_GE(share, last_share);
    EXPECT_LE(cost, last_cost);
    last_share = share;
    last_cost = cost;
  };
  const Minimum found = minimise(valley, options);
  EXPECT_GT(last_share, 0.95);
  EXPECT_EQ(last_cost, found.cost);
}

}  // namespace minimise_test
}  // namespace twin::studies::search
