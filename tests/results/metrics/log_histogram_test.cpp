#include "results/metrics/log_histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace twin::results {
namespace log_histogram_test {

TEST(LogHistogram, QuantilesAgreeWithSortingToWithinABin) {
  std::mt19937 random(1);
  std::lognormal_distribution<double> time(std::log(4e-7), 0.8);
  LogHistogram histogram;
  std::vector<double> all;
  for (int i = 0; i < 20001; ++i) {
    all.push_back(time(random));
    histogram.add(all.back());
  }
  std::sort(all.begin(), all.end());
  for (const double q : {0.01, 0.5, 0.99, 0.999}) {
    const double exact = all[static_cast<std::size_t>(q * 20000)];
    EXPECT_NEAR(histogram.quantile(q) / exact, 1.0, 0.05) << q;
  }
  EXPECT_EQ(histogram.quantile(1.0), all.back());
  EXPECT_EQ(histogram.max(), all.back());
  EXPECT_EQ(histogram.count(), 20001);
}

TEST(LogHistogram, NumbersOutsideTheRangeAreCounted) {
  LogHistogram histogram;
  for (const double x : {0.0, -1.0, 1e-30, 1e9, std::numeric_limits<double>::infinity()}) {
    histogram.add(x);
  }
  EXPECT_EQ(histogram.count(), 5);
  EXPECT_LE(histogram.quantile(0.5), 1.1e-9);
}

TEST(LogHistogram, EmptyIsZero) {
  EXPECT_EQ(LogHistogram().quantile(0.5), 0.0);
  EXPECT_EQ(LogHistogram().max(), 0.0);
}

}  // namespace log_histogram_test
}  // namespace twin::results
