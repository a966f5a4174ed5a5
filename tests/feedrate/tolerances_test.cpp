#include "feedrate/tolerances.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/support/blocks.hpp"
#include "tests/support/plan.hpp"
#include "tests/support/random_program.hpp"

namespace twin::feedrate {
namespace tolerances_test {

/// A path of lines and arcs, and the limits to match, drawn larger by a factor. To a tolerance in
/// mm that is the same as a smaller tolerance on the path as it was. With a power of two nothing
/// else changes: every product, quotient and root is rounded as before.
struct Drawn {
  std::vector<gcode::Block> blocks;
  test::PlanSettings settings;
};

Drawn drawn(std::vector<gcode::Block> blocks, double scale, Planner planner) {
  for (gcode::Block& block : blocks) {
    block.start *= scale;
    block.end *= scale;
    block.feedrate *= scale;
    block.arc.centre *= scale;
    block.arc.radius *= scale;
    block.arc.rise *= scale;
  }
  test::PlanSettings settings;
  settings.path.planner = planner;
  settings.path.curves = CurveKind::kNone;  // fitting has tolerances of its own
  settings.path.chord_error *= scale;
  settings.path.short_block_length *= scale;
  settings.model.circular_error *= scale;
  settings.model.critical_feedrate *= scale;
  settings.model.corner_error *= scale;
  settings.limits.feedrate *= scale;
  settings.limits.rapid_feedrate *= scale;
  settings.limits.acceleration *= scale;
  settings.limits.jerk *= scale;
  return {std::move(blocks), settings};
}

double planned_time(const Drawn& drawn) {
  const test::Plan plan = test::plan(drawn.blocks, drawn.settings);
  EXPECT_EQ(plan.fallbacks, 0);
  return plan.time;
}

TEST(Tolerances, NoPlanHangsOnThem) {
  std::mt19937 random(11);
  for (int i = 0; i < 40; ++i) {
    const auto blocks = test::random_program(random, 15);
    for (const Planner planner : {Planner::kPaper, Planner::kCertified}) {
      const double time = planned_time(drawn(blocks, 1.0, planner));
      for (const double scale : {1.0 / 64.0, 0.125, 8.0, 64.0}) {
        EXPECT_NEAR(planned_time(drawn(blocks, scale, planner)), time, 1e-6 * time)
            << "program " << i << " scale " << scale << " planner " << static_cast<int>(planner);
      }
    }
  }
}

TEST(Tolerances, AreFarBelowWhatAProgramHoldsAndInTheirOrder) {
  constexpr double kShortestBlock = 1e-4;  // [mm], what four decimals can write
  EXPECT_LT(kTouchRounding, kPlaceRounding);
  EXPECT_LE(kDistanceRounding, kPlaceRounding);
  EXPECT_LT(1e4 * kPlaceRounding, kShortestBlock);
  EXPECT_LT(kFormulaRounding, kFeedrateRounding);
}

}  // namespace tolerances_test
}  // namespace twin::feedrate
