#include "studies/reproduce/reproduction.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <vector>

namespace twin::studies::reproduce {
namespace phases_test {

constexpr double kCycle = 2.0 * std::numbers::pi;

std::array<double, 3> phases(int repeat) {
  const hal::mujoco::TableParams table = with_phases_of_repeat(hal::mujoco::TableParams{}, repeat);
  EXPECT_EQ(table.axis[0].drive.hum_phase, table.axis[1].drive.hum_phase);  // one mains
  return {table.axis[0].encoder.phase, table.axis[1].encoder.phase,
          table.axis[0].drive.hum_phase / kCycle};
}

TEST(Phases, RepeatZeroIsTheTableAsItIs) {
  const hal::mujoco::TableParams table;
  const auto first = phases(0);
  EXPECT_DOUBLE_EQ(first[0], table.axis[0].encoder.phase);
  EXPECT_DOUBLE_EQ(first[1], table.axis[1].encoder.phase);
  EXPECT_DOUBLE_EQ(first[2], table.axis[0].drive.hum_phase / kCycle);
}

TEST(Phases, LieWithinACycle) {
  for (int repeat = 0; repeat < 1000; ++repeat) {
    for (const double phase : phases(repeat)) {
      ASSERT_GE(phase, 0.0);
      ASSERT_LT(phase, 1.0);
    }
  }
}

/// The star discrepancy of a phase: how far the share of points below x is off x, at worst.
double discrepancy(std::size_t which, int repeats) {
  std::vector<double> points;
  for (int repeat = 1; repeat <= repeats; ++repeat) {
    points.push_back(phases(repeat)[which]);
  }
  std::sort(points.begin(), points.end());
  double worst = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto n = static_cast<double>(points.size());
    const auto k = static_cast<double>(i);
    worst = std::max({worst, std::abs(points[i] - k / n), std::abs(points[i] - (k + 1.0) / n)});
  }
  return worst;
}

TEST(Phases, AreSpreadEvenly) {
  for (const std::size_t which : {0U, 1U, 2U}) {
    EXPECT_LT(discrepancy(which, 10), 0.25) << which;   // random points: 0.37 at the median
    EXPECT_LT(discrepancy(which, 100), 0.06) << which;  // random points: 0.08
  }
}

/// Ten equal runs would say nothing: phases of the axes are not tied to each other.
TEST(Phases, AxesMoveIndependently) {
  int quadrants = 0;
  for (int repeat = 1; repeat <= 10; ++repeat) {
    const auto p = phases(repeat);
    quadrants |= 1 << ((p[0] < 0.5 ? 0 : 1) + (p[1] < 0.5 ? 0 : 2));
  }
  EXPECT_EQ(quadrants, 0b1111);
}

}  // namespace phases_test
}  // namespace twin::studies::reproduce
