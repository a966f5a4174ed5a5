#include <gtest/gtest.h>

#include <random>

#include "bound_of.hpp"
#include "tests/support/random_program.hpp"

namespace twin::feedrate {
namespace random_bound_test {

TEST(RandomBound, NoPlanIsFasterThanItsBound) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    const auto blocks = test::random_program(random, 12);
    for (const CurveKind curves : {CurveKind::kNurbs, CurveKind::kBezier, CurveKind::kNone}) {
      test::PlanSettings settings;
      settings.path.curves = curves;
      settings.path.planner = curves == CurveKind::kNurbs ? Planner::kCertified : Planner::kPaper;
      const auto plan = test::plan(blocks, settings);
      const test::Bounds bounds = test::bounds_of(plan, settings);
      EXPECT_LE(bounds.without_jerk, bounds.with_jerk) << seed;
      EXPECT_LE(bounds.with_jerk, plan.time * (1.0 + 1e-9)) << seed;
    }
  }
}

// With next to no limit of jerk the plan is nearly as fast as the bound.
TEST(RandomBound, NoPlanOfVeryHighJerkIsFasterThanItsBound) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    const auto blocks = test::random_program(random, 12);
    for (const double jerk : {1e6, 1e7, 1e9}) {
      test::PlanSettings settings;
      settings.path.planner = Planner::kCertified;
      settings.limits.jerk = jerk;
      const auto plan = test::plan(blocks, settings);
      EXPECT_LE(test::bounds_of(plan, settings).with_jerk, plan.time * (1.0 + 1e-9))
          << seed << " " << jerk;
    }
  }
}

TEST(RandomBound, MoreJerkBringsThePlanCloserToTheBoundAndNeverBelow) {
  double before = 1e9;
  for (const double jerk : {5e4, 5e5, 5e6, 5e7}) {
    std::mt19937 random(3);
    test::PlanSettings settings;
    settings.limits.jerk = jerk;
    settings.model.corner_error = 0.001;
    const auto plan = test::plan(test::random_program(random, 8), settings);
    const double ratio = plan.time / test::bound_of(plan, settings);
    EXPECT_GE(ratio, 1.0);
    EXPECT_LT(ratio, before);
    before = ratio;
  }
}

}  // namespace random_bound_test
}  // namespace twin::feedrate
