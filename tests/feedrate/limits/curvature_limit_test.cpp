#include "feedrate/limits/feedrate_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twin::feedrate {
namespace curvature_limit_test {

/// The relative shrinking of a circle by a first-order loop with feedforward, Eq. 3 as printed:
/// |(Kf j w + Kp) / (j w + Kp)|.
double shrunk_radius_error(double curvature, double feedrate, const PlanningModel& model) {
  const double w = feedrate * curvature;
  const double gain = std::sqrt((model.kf * model.kf * w * w + model.kp * model.kp) /
                                (w * w + model.kp * model.kp));
  return (1.0 - gain) / curvature;
}

TEST(CurvatureLimit, CriticalCurvatureAtTable2IsARadiusOf1020Micrometres) {
  EXPECT_NEAR(critical_curvature(2450.0, 50.0), 0.98, 1e-12);
}

TEST(CurvatureLimit, PutBackIntoEquation3GivesTheCircularError) {
  PlanningModel model;
  for (const double kf : {0.0, 0.34, 0.7}) {
    model.kf = kf;
    for (double curvature = 0.01; curvature * model.circular_error < 0.9 * (1.0 - kf);
         curvature *= 1.4) {
      const double v = servo_model_feedrate(curvature, model);
      ASSERT_TRUE(std::isfinite(v));
      EXPECT_NEAR(shrunk_radius_error(curvature, v, model), model.circular_error, 1e-9);
    }
  }
}

TEST(CurvatureLimit, IsInfiniteWhereFeedforwardKeepsTheToleranceAtAnySpeed) {
  PlanningModel model;
  model.kf = 0.9;
  // 1 - kappa eps <= Kf from kappa = 20 1/mm on.
  EXPECT_TRUE(std::isfinite(servo_model_feedrate(19.0, model)));
  for (const double curvature : {20.1, 50.0, 1000.0}) {
    EXPECT_TRUE(std::isinf(servo_model_feedrate(curvature, model)));
    EXPECT_LE(shrunk_radius_error(curvature, 1e9, model), model.circular_error);
  }
}

TEST(CurvatureLimit, IsInfiniteOnAStraightLine) {
  EXPECT_TRUE(std::isinf(servo_model_feedrate(0.0, PlanningModel{})));
}

TEST(CurvatureLimit, LeavesTheProgrammedFeedrateBelowTheCriticalCurvature) {
  const Limits limits;
  for (const double v : {5.0, 50.0, 150.0}) {
    const double critical = critical_curvature(limits.acceleration, v);
    EXPECT_EQ(curvature_feedrate(0.0, v, {}, limits), v);
    EXPECT_EQ(curvature_feedrate(0.999 * critical, v, {}, limits), v);
  }
}

TEST(CurvatureLimit, JumpsDownToTheServoModelAtTheCriticalCurvature) {
  const Limits limits;
  const PlanningModel model;
  const double critical = critical_curvature(limits.acceleration, 50.0);
  const double above = curvature_feedrate(1.0001 * critical, 50.0, model, limits);
  EXPECT_NEAR(above, servo_model_feedrate(1.0001 * critical, model), 1e-9);
  EXPECT_LT(above, 0.6 * 50.0);
}

TEST(CurvatureLimit, KeepsTheNormalAccelerationAtEveryCurvature) {
  Limits limits;
  for (const double kf : {0.0, 0.34, 0.95}) {
    PlanningModel model;
    model.kf = kf;
    for (const double v : {1.0, 20.0, 50.0, 200.0}) {
      for (double curvature = 1e-4; curvature < 1e4; curvature *= 1.05) {
        const double limit = curvature_feedrate(curvature, v, model, limits);
        EXPECT_LE(limit, v);
        EXPECT_GT(limit, 0.0);
        EXPECT_LE(curvature * limit * limit, limits.acceleration * (1.0 + 1e-12));
      }
    }
  }
}

TEST(CurvatureLimit,
     TheMonotoneRuleIsThatOfThePaperAtItsCriticalFeedrateAndNeverFallsWithTheFeedrate) {
  const Limits limits;
  const PlanningModel model;
  for (double curvature = 1e-4; curvature < 1e4; curvature *= 1.05) {
    EXPECT_DOUBLE_EQ(monotone_curvature_feedrate(curvature, 50.0, model, limits),
                     curvature_feedrate(curvature, 50.0, model, limits));
    double before = 0.0;
    for (double v = 1.0; v < 1000.0; v *= 1.1) {
      const double limit = monotone_curvature_feedrate(curvature, v, model, limits);
      EXPECT_GE(limit, before);
      EXPECT_LE(limit, v);
      EXPECT_LE(curvature * limit * limit, limits.acceleration * (1.0 + 1e-12));
      before = limit;
    }
  }
  EXPECT_EQ(monotone_curvature_feedrate(0.0, 50.0, model, limits), 50.0);
}

}  // namespace curvature_limit_test
}  // namespace twin::feedrate
