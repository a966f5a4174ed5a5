#include "feedrate/limits/feedrate_rules.hpp"

#include <gtest/gtest.h>

#include "tests/support/blocks.hpp"
#include "tests/support/plan.hpp"
#include "tests/support/random_program.hpp"

namespace twin::feedrate {
namespace feedrate_rules_test {

constexpr double kPeriod = 1e-3;  // [s]
const Limits kLimits;

FeedrateRules rules(FeedrateRule rule, CurveKind curves = CurveKind::kNurbs) {
  PlanningModel model;
  model.feedrate_rule = rule;
  PathSettings path;
  path.curves = curves;
  return {kLimits, model, path, kPeriod};
}

TEST(FeedrateRules, ConstantIsTheProgrammedFeedrateAtAnyCurvature) {
  for (double curvature = 0.0; curvature < 1e4; curvature = 1.5 * curvature + 0.01) {
    EXPECT_EQ(rules(FeedrateRule::kConstant).limit_at({curvature}, 50.0, On::kCurve), 50.0);
    EXPECT_EQ(rules(FeedrateRule::kConstant).limit_at({curvature}, 50.0, On::kArcOrLine), 50.0);
  }
}

TEST(FeedrateRules, AutoIsTheServoModelButConstantOnBezierPieces) {
  const LocalGeometry round{2.0};
  const double servo = curvature_feedrate(2.0, 50.0, {}, kLimits);
  ASSERT_LT(servo, 35.0);
  EXPECT_EQ(rules(FeedrateRule::kServoModel).limit_at(round, 50.0, On::kCurve), servo);
  EXPECT_EQ(rules(FeedrateRule::kServoModel, CurveKind::kBezier).limit_at(round, 50.0, On::kCurve),
            servo);
  for (const CurveKind curves : {CurveKind::kNurbs, CurveKind::kBezier, CurveKind::kNone}) {
    EXPECT_EQ(rules(FeedrateRule::kAuto, curves).limit_at(round, 50.0, On::kArcOrLine), servo);
    EXPECT_EQ(rules(FeedrateRule::kAuto, curves).limit_at(round, 50.0, On::kCurve),
              curves == CurveKind::kBezier ? 50.0 : servo);
  }
}

TEST(FeedrateRules, AllButConstantKeepTheNormalAccelerationAndTheLargestFeedrate) {
  for (const FeedrateRule rule :
       {FeedrateRule::kChordError, FeedrateRule::kServoModel, FeedrateRule::kContactSpeed}) {
    PlanningModel model;
    model.feedrate_rule = rule;
    model.tool_radius = 3.0;
    const FeedrateRules tested(kLimits, model, {}, kPeriod);
    for (double curvature = 1e-4; curvature < 1e4; curvature *= 1.1) {
      for (const double sign : {1.0, -1.0}) {
        const double v = tested.limit_at({curvature, 1.0, sign * curvature}, 150.0, On::kCurve);
        EXPECT_GT(v, 0.0);
        EXPECT_LE(v, kLimits.feedrate);
        EXPECT_LE(curvature * v * v, kLimits.acceleration * (1.0 + 1e-12));
      }
    }
  }
}

TEST(FeedrateRules, RandomProgramsArePlannedWholeByEachRule) {
  std::mt19937 random(6);
  for (int i = 0; i < 60; ++i) {
    const auto blocks = test::random_program(random, 25);
    for (const FeedrateRule rule :
         {FeedrateRule::kConstant, FeedrateRule::kChordError, FeedrateRule::kContactSpeed}) {
      test::PlanSettings settings;
      settings.look_ahead = i % 2 == 0 ? 20 : 200;
      settings.period = i % 3 == 0 ? 4e-3 : 1e-3;
      settings.model.feedrate_rule = rule;
      settings.path.planner =
          rule == FeedrateRule::kChordError ? Planner::kCertified : Planner::kPaper;
      settings.model.tool_radius = 2.0;
      settings.model.tool_side = i % 4 == 0 ? ToolSide::kLeft : ToolSide::kRight;
      const auto planned = test::plan(blocks, settings);
      ASSERT_NO_FATAL_FAILURE(
          test::expect_whole(planned, settings.limits, rule != FeedrateRule::kConstant))
          << "program " << i << " rule " << static_cast<int>(rule);
      EXPECT_EQ(planned.fallbacks, 0) << "program " << i << " rule " << static_cast<int>(rule);
    }
  }
}

}  // namespace feedrate_rules_test
}  // namespace twin::feedrate
