#include "studies/circular/servo_prediction.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "feedrate/limits/feedrate_rules.hpp"

namespace twin::studies::circular {
namespace servo_prediction_test {

motion::Gains gains(double kp, double kf) {
  motion::Gains g;
  g.kp = kp;
  g.kf = kf;
  return g;
}

// The planner has Eq. 3 solved for the feedrate (Eqs. 4, 5).
TEST(ServoPrediction, IsTheInverseOfTheServoModelFeedrate) {
  PlanningModel model;
  for (const double kf : {0.0, 0.34, 0.9}) {
    for (const double radius : {1.0, 20.0}) {
      model.kf = kf;
      model.circular_error = 0.004;
      const double feedrate = feedrate::servo_model_feedrate(1.0 / radius, model);
      const auto predicted =
          predicted_radial_deviation({gains(model.kp, kf), gains(model.kp, kf)}, radius, feedrate);
      ASSERT_TRUE(predicted);
      EXPECT_NEAR(*predicted, -0.004, 1e-12) << kf << ", " << radius;
    }
  }
}

TEST(ServoPrediction, IsTheMeanOverBothAxes) {
  const auto x = predicted_radial_deviation({gains(50.0, 0.0), gains(50.0, 0.0)}, 10.0, 50.0);
  const auto y = predicted_radial_deviation({gains(80.0, 1.2), gains(80.0, 1.2)}, 10.0, 50.0);
  const auto both = predicted_radial_deviation({gains(50.0, 0.0), gains(80.0, 1.2)}, 10.0, 50.0);
  ASSERT_TRUE(x && y && both);
  EXPECT_LT(*x, 0.0);
  EXPECT_GT(*y, 0.0);  // too much feedforward: too large
  EXPECT_NEAR(*both, 0.5 * (*x + *y), 1e-15);
}

TEST(ServoPrediction, IsRefusedForGainsThatEquationThreeDoesNotKnow) {
  motion::Gains with_ka = gains(150.0, 1.0);
  with_ka.ka = 0.002;
  const auto predicted = predicted_radial_deviation({gains(150.0, 1.0), with_ka}, 10.0, 50.0);
  ASSERT_FALSE(predicted);
  EXPECT_THAT(predicted.error().message, ::testing::HasSubstr("Ka, and servo.y has"));
}

}  // namespace servo_prediction_test
}  // namespace twin::studies::circular
