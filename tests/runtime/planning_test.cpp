#include "runtime/planning.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/planned.hpp"

namespace twin::runtime {
namespace planning_test {

constexpr double kPi = std::numbers::pi;

Expected<PlanFigures> plan(const std::string& text, const config::MachineFile& machine = {}) {
  auto reader = gcode::Reader::from_text(text, "text");
  return plan_program(reader, machine, [](auto&&) { return true; });
}

/// Sine of short blocks, 0.2 mm apart in X.
std::string short_blocks(int count) {
  std::string text = "G01 F1200\n";
  for (int i = 1; i <= count; ++i) {
    text += fmt::format("X{:.4f} Y{:.4f}\n", 0.2 * i, 3.0 * std::sin(0.2 * i / 5.0));
  }
  return text;
}

/// Time of a line from rest to rest that reaches its feedrate, without a phase of constant
/// acceleration: each ramp takes 2 sqrt(V / J) and covers half of V times that.
double rest_to_rest(double length, double feedrate, double jerk) {
  return length / feedrate + 2.0 * std::sqrt(feedrate / jerk);
}

TEST(Planning, TimeOfOneLineIsThatOfTheSCurve) {
  const config::MachineFile machine;
  const auto figures = plan("G01 X100 F3000\n");
  ASSERT_TRUE(figures);
  EXPECT_NEAR(figures->time, rest_to_rest(100.0, 50.0, machine.limits.jerk), 1e-9);
  EXPECT_EQ(figures->fallbacks, 0);
}

TEST(Planning, CountsBlocksSharedByCurvesOnceAndKeepsTheLargestBound) {
  const config::MachineFile machine;
  const auto figures = plan(short_blocks(500), machine);
  ASSERT_TRUE(figures);
  EXPECT_EQ(figures->blocks, 500);
  EXPECT_EQ(figures->short_length.count(), 500);
  EXPECT_GT(figures->fitted_curves, 1);
  EXPECT_GT(figures->spans, figures->fitted_curves);
  EXPECT_GT(figures->deviation, 0.0);
  EXPECT_LE(figures->deviation, machine.planning.corner_error);
}

TEST(Planning, DwellsAndExactStopsAddUp) {
  const config::MachineFile machine;
  const double line = rest_to_rest(60.0, 50.0, machine.limits.jerk);
  const auto stops = plan("G61\nG01 X60 F3000\nY60\nG04 P0.25\nX0\n");
  ASSERT_TRUE(stops);
  EXPECT_NEAR(stops->time, 3.0 * line + 0.25, 1e-9);
}

TEST(Planning, CountsBlocksAndSegmentsAndMeasuresThePath) {
  config::MachineFile machine;
  machine.path.planner = Planner::kPaper;
  const auto figures = plan("G01 X40 F3000\nY40\nG03 X40 Y40 I-20\nG04 P1\nG00 X0 Y0\n", machine);
  ASSERT_TRUE(figures);
  EXPECT_EQ(figures->blocks, 4);
  EXPECT_EQ(figures->lines, 3);
  EXPECT_EQ(figures->arcs, 1);
  EXPECT_EQ(figures->curves, 0);
  EXPECT_NEAR(figures->path_length, 80.0 + 40.0 * kPi + std::hypot(40.0, 40.0), 1e-9);
  EXPECT_EQ(figures->short_length.count(), 0);
}

TEST(Planning, ShortBlocksBecomeCurvesAndTheirLengthsAreThoseOfTheProgram) {
  constexpr int kBlocks = 200;
  config::MachineFile machine;
  machine.path.planner = Planner::kPaper;
  const auto figures = plan(short_blocks(kBlocks), machine);
  ASSERT_TRUE(figures);
  EXPECT_EQ(figures->blocks, kBlocks);
  EXPECT_EQ(figures->short_length.count(), kBlocks);
  EXPECT_GE(figures->curves, kBlocks / 20);
  EXPECT_LE(figures->curves, kBlocks / 20 + 2);
  const auto chord = [](int i) {
    return std::hypot(0.2, 3.0 * (std::sin(0.2 * i / 5.0) - std::sin(0.2 * (i - 1) / 5.0)));
  };
  double sum = 0.0;
  for (int i = 1; i <= kBlocks; ++i) {
    sum += chord(i);
  }
  EXPECT_NEAR(figures->short_length.mean(), sum / kBlocks, 1e-6);
  EXPECT_NEAR(figures->short_length.max(), chord(1), 2e-4);
  // A curve through the corners is no shorter than the polygon, and close to it.
  EXPECT_GE(figures->path_length, sum - 0.001);
  EXPECT_LE(figures->path_length, sum + 0.01);
}

TEST(Planning, LinearLeavesTheBlocksAsTheyAre) {
  config::MachineFile machine;
  machine.path.planner = Planner::kPaper;
  machine.path.curves = CurveKind::kNone;
  const auto figures = plan(short_blocks(50), machine);
  ASSERT_TRUE(figures);
  EXPECT_EQ(figures->curves, 0);
  EXPECT_EQ(figures->lines, 50);
}

TEST(Planning, SegmentsAreNumberedAndJoinWithoutGaps) {
  const auto planned = test::plan_text(short_blocks(120) + "G02 X30 Y0 R40\nG01 X0\n");
  ASSERT_GT(planned.size(), 3U);
  for (std::size_t i = 0; i < planned.size(); ++i) {
    EXPECT_EQ(planned[i].index, static_cast<std::int64_t>(i));
    double covered = 0.0;
    for (const feedrate::Phase& phase : planned[i].phases) {
      EXPECT_NEAR(phase.s, covered, 1e-9);
      covered = feedrate::motion_at(phase, phase.duration).s;
    }
    EXPECT_NEAR(covered, planned[i].segment.length, 1e-9);
    if (i > 0) {
      EXPECT_LT((planned[i].segment.begin.position - planned[i - 1].segment.end.position).norm(),
                1e-9);
    }
  }
}

TEST(Planning, EndsWhenTheSinkSaysSo) {
  auto reader = gcode::Reader::from_text("G61\nG01 X1 F600\nX2\nX3\nX4\n", "text");
  int taken = 0;
  const auto figures = plan_program(reader, {}, [&](auto&&) { return ++taken < 2; });
  ASSERT_TRUE(figures);
  EXPECT_EQ(taken, 2);
}

TEST(Planning, PassesOnTheReadersError) {
  const auto figures = plan("G01 X1 F600\nG77\n");
  ASSERT_FALSE(figures);
  EXPECT_EQ(figures.error().line, 2);
}

}  // namespace planning_test
}  // namespace twin::runtime
