#include "studies/circular/deviations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "feedrate/limits/feedrate_rules.hpp"
#include "paths.hpp"

namespace twin::studies::circular {
namespace deviations_test {

using test::path_of;

TEST(Deviations, OfTheNominalCircleAreNothing) {
  const auto same = [](double) { return 20.0; };
  const Deviations d = evaluate({path_of(same), path_of(same, Sense::kClockwise)}, 20.0);
  EXPECT_NEAR(d.sense[0].circular, 0.0, 1e-9);
  EXPECT_NEAR(d.bidirectional, 0.0, 1e-9);
  EXPECT_NEAR(d.hysteresis, 0.0, 1e-9);
  EXPECT_NEAR(d.mean_radial, 0.0, 1e-9);
  EXPECT_NEAR(d.sense[1].radial_max, 0.0, 1e-9);
}

TEST(Deviations, OfAShiftedCircleAreRadialOnly) {
  const Vec2 off(0.006, -0.008);
  const auto same = [](double) { return 20.0; };
  const Deviations d = evaluate(
      {path_of(same, Sense::kCounterClockwise, off), path_of(same, Sense::kClockwise, off)}, 20.0);
  for (const SenseDeviations& sense : d.sense) {
    EXPECT_NEAR(sense.circular, 0.0, 1e-9);
    EXPECT_NEAR(sense.radial_max, 0.010, 1e-6);
    EXPECT_NEAR(sense.radial_min, -0.010, 1e-6);
    EXPECT_NEAR((sense.least_squares.centre - off).norm(), 0.0, 1e-9);
  }
  EXPECT_NEAR(d.bidirectional, 0.0, 1e-9);
  EXPECT_NEAR(d.hysteresis, 0.0, 1e-6);
  EXPECT_NEAR(d.mean_radial, 0.0, 1e-9);
}

TEST(Deviations, OfAnEllipseInOneSenseAndACircleInTheOther) {
  const auto ellipse = [](double a) {
    return 1.0 / std::hypot(std::cos(a) / 20.008, std::sin(a) / 19.996);
  };
  const auto circle = [](double) { return 20.002; };
  const Deviations d = evaluate({path_of(ellipse), path_of(circle, Sense::kClockwise)}, 20.0);
  EXPECT_NEAR(d.sense[0].circular, 0.012, 1e-7);
  EXPECT_NEAR(d.sense[0].radial_max, 0.008, 1e-7);
  EXPECT_NEAR(d.sense[0].radial_min, -0.004, 1e-7);
  EXPECT_NEAR(d.sense[1].circular, 0.0, 1e-9);
  EXPECT_NEAR(d.sense[1].radial_min, 0.002, 1e-9);
  EXPECT_NEAR(d.bidirectional, 0.012, 1e-7);  // the circle lies within the ellipse's zone
  EXPECT_NEAR(d.hysteresis, 0.006, 1e-7);
  EXPECT_NEAR(d.mean_radial, 0.002, 1e-6);
}

// One sense a little larger than the other, as from a lag: hysteresis, but no circular deviation.
TEST(Deviations, OfTwoCirclesAreTheirDifferenceInRadius) {
  const Deviations d = evaluate({path_of([](double) { return 20.003; }),
                                 path_of([](double) { return 19.998; }, Sense::kClockwise)},
                                20.0);
  EXPECT_NEAR(d.sense[0].circular, 0.0, 1e-9);
  EXPECT_NEAR(d.sense[1].circular, 0.0, 1e-9);
  EXPECT_NEAR(d.bidirectional, 0.005, 1e-7);
  EXPECT_NEAR(d.hysteresis, 0.005, 1e-9);
  EXPECT_NEAR(d.mean_radial, 0.0005, 1e-9);
}

// Backlash b of X: the table stays behind by half of it, on the side it comes from.
// Counter-clockwise X falls where y > 0, so the path lies +b/2 off in x there and -b/2 below;
// clockwise the other way.
TEST(Deviations, OfBacklashAreAHysteresisOfItsSize) {
  const double backlash = 0.010;
  const auto with_backlash = [&](Sense sense) {
    auto path = path_of([](double) { return 20.0; }, sense);
    for (Vec2& point : path) {
      point.x() += sign_of(sense) * std::copysign(0.5 * backlash, point.y());
    }
    return path;
  };
  const Deviations d =
      evaluate({with_backlash(Sense::kCounterClockwise), with_backlash(Sense::kClockwise)}, 20.0);
  EXPECT_NEAR(d.hysteresis, backlash, 2e-5);
  EXPECT_NEAR(d.sense[0].radial_max, 0.5 * backlash, 1e-5);
  EXPECT_NEAR(d.sense[0].radial_min, -0.5 * backlash, 1e-5);
  EXPECT_NEAR(d.mean_radial, 0.0, 1e-5);
}

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

}  // namespace deviations_test
}  // namespace twin::studies::circular
