#include "studies/compare/bounded_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gcode/reader.hpp"
#include "runtime/planning.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::compare {
namespace bounded_plan_test {

class BoundedPlanTest : public ::testing::Test {
 protected:
  BoundedPlan plan(const std::string& text) {
    auto result = bounded_plan(gcode::ProgramText::from_text(text, "program.nc"), machine, {},
                               Profiles::kRecorded);
    EXPECT_TRUE(result);
    return std::move(*result);
  }

  test::TempFolder folder;
  config::MachineFile machine;
};

constexpr const char* kCorner = "G01 X20 F3000\nX30 Y10\nG04 P0.5\nY40\nM30\n";

TEST_F(BoundedPlanTest, TheProfilesTakeTheTimesOfThePlanLessItsDwell) {
  const BoundedPlan result = plan(kCorner);
  auto reader = gcode::Reader::from_text(kCorner, "corner");
  const auto figures = runtime::plan_program(reader, machine, [](auto&&) { return true; });
  ASSERT_TRUE(figures);
  EXPECT_NEAR(result.planned.at(result.planned.rows() - 1, 2), figures->time - 0.5, 1e-9);
  EXPECT_NEAR(result.bound.at(result.bound.rows() - 1, 2), result.time_bound - 0.5, 1e-9);
}

TEST_F(BoundedPlanTest, LostTimeRisesFromNothingToTheWholeDifference) {
  const BoundedPlan result = plan(kCorner);
  const results::Table lost = lost_time(result, 200);
  const std::size_t last = lost.rows() - 1;
  EXPECT_NEAR(lost.at(0, 1), 0.0, 1e-12);
  EXPECT_NEAR(
      lost.at(last, 1),
      result.planned.at(result.planned.rows() - 1, 2) - result.bound.at(result.bound.rows() - 1, 2),
      1e-9);
  for (std::size_t i = 1; i <= last; ++i) {
    EXPECT_GE(lost.at(i, 1), lost.at(i - 1, 1) - 1e-6);
  }
}

/// From rest, J limits: the plan has gone J t^3 / 6 where the bound has gone A t^2 / 2.
TEST_F(BoundedPlanTest, LostTimeOnTheFirstMicrometresIsThatOfTheJerk) {
  const BoundedPlan result = plan("G01 X50 F3000\nM30\n");
  const results::Table lost = lost_time(result, 10000);
  const double s = lost.at(1, 0);
  const double expected =
      std::cbrt(6.0 * s / machine.limits.jerk) - std::sqrt(2.0 * s / machine.limits.acceleration);
  EXPECT_NEAR(lost.at(1, 1), expected, 0.03 * expected);
}

TEST_F(BoundedPlanTest, AThinnedProfileKeepsItsExtremesAndItsShape) {
  const BoundedPlan result = plan("G01 X40 F3000\nX20\nM30\n");
  for (const results::Table* const profile : {&result.planned, &result.bound}) {
    const results::Table thin = thinned(*profile, 100);
    double most = 0.0;
    for (std::size_t i = 0; i < thin.rows(); ++i) {
      const double s = thin.at(i, 0);
      most = std::max(most, thin.at(i, 1));
      // Away from the three rests the feedrate is held.
      if (std::min({s, std::abs(s - 40.0), 60.0 - s}) > 3.0) {
        EXPECT_NEAR(thin.at(i, 1), 50.0, 1e-6) << s;
      }
    }
    EXPECT_NEAR(most, 50.0, 1e-6);
    EXPECT_LT(thin.rows(), 310U);
  }
}

}  // namespace bounded_plan_test
}  // namespace twin::studies::compare
