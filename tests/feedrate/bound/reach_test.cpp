#include "feedrate/bound/reach.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace twin::feedrate {
namespace reach_test {

/// Range of u that all limits of a cell leave at q, by themselves [mm/s^2].
struct Range {
  double low;
  double high;
};

Range range_at(const Cell& cell, double q) {
  Range range{-cell.acceleration, cell.acceleration};
  for (std::size_t i = 0; i < cell.strips.count; ++i) {
    const Strip& s = cell.strips.strip[i];
    if (s.a == 0.0) {
      if (std::abs(s.b * q) > s.c) {
        return {1.0, -1.0};
      }
      continue;
    }
    const double one = (s.c - s.b * q) / s.a;
    const double other = (-s.c - s.b * q) / s.a;
    range.low = std::max(range.low, std::min(one, other));
    range.high = std::min(range.high, std::max(one, other));
  }
  return range;
}

Cell random_cell(std::mt19937& random) {
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  Cell cell{0.05 + 0.04 * part(random), 2500.0, 2450.0, {}};
  for (int i = 0; i < 4; ++i) {
    const bool is_vertical = part(random) > 0.8;
    cell.strips.add({is_vertical ? 0.0 : part(random), part(random), 900.0 + 500.0 * part(random)});
  }
  return cell;
}

TEST(Reach, TheLargestControllableQIsThatOfASearch) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int n = 0; n < 500; ++n) {
    const Cell cell = random_cell(random);
    const double end = 2500.0 * part(random);
    double searched = 0.0;
    constexpr double kStep = 0.25;
    for (double q = 0.0; q <= cell.cap; q += kStep) {
      const Range u = range_at(cell, q);
      const double most = std::min(u.high, (end - q) / (2.0 * cell.length));
      if (u.low <= most && q + 2.0 * most * cell.length >= 0.0) {
        searched = q;
      }
    }
    EXPECT_NEAR(largest_begin(cell, end), searched, kStep) << n;
  }
}

TEST(Reach, TheForwardStepKeepsEveryLimitAndCannotBeRaised) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int n = 0; n < 500; ++n) {
    const Cell cell = random_cell(random);
    const double end = 2500.0 * part(random);
    const double begin = part(random) * largest_begin(cell, end);
    const double reached = largest_end(cell, begin, end);
    const double u = (reached - begin) / (2.0 * cell.length);
    const Range range = range_at(cell, begin);
    EXPECT_LE(u, range.high + 1e-6);
    EXPECT_GE(u, range.low - 1e-6);
    EXPECT_LE(reached, end + 1e-9);
    EXPECT_TRUE(u > range.high - 1e-6 || reached > end - 1e-6);
  }
}

TEST(Reach, ACellFromRestToRestTakesItsClosedForm) {
  const Cell free{1.0, 1e9, 2450.0, {}};
  EXPECT_NEAR(cell_time(free, 0.0, 0.0), 2.0 * std::sqrt(1.0 / 2450.0), 1e-12);
  const Cell capped{1.0, 100.0, 2450.0, {}};
  EXPECT_NEAR(cell_time(capped, 0.0, 0.0), 1.0 / 10.0 + 10.0 / 2450.0, 1e-12);
}

}  // namespace reach_test
}  // namespace twin::feedrate
