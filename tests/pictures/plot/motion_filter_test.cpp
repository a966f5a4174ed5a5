#include "pictures/plot/motion_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace twin::pictures {
namespace motion_filter_test {

/// The motions at all set points of s(t) along a shape, with the machine at rest before and after.
std::vector<TangentialMotion> motions(double period, int count,
                                      const std::function<Vec3(double)>& point_at,
                                      double feedrate = 0.0) {
  MotionFilter motion(period);
  std::vector<TangentialMotion> result;
  for (int i = 0; i < count + static_cast<int>(motion.delay()); ++i) {
    if (const auto got = motion.push(point_at(std::min(i, count - 1) * period), feedrate)) {
      result.push_back(*got);
    }
  }
  return result;
}

/// Arc length at the constant jerk J from rest.
constexpr double kJerk = 5000.0;  // [mm/s^3]
double arc(double t) { return kJerk * t * t * t / 6.0; }

void expect_constant_jerk(double period, const std::function<Vec3(double)>& shape,
                          double jerk_tolerance) {
  const int count = static_cast<int>(std::lround(0.2 / period));
  const auto got = motions(period, count, [&](double t) { return shape(arc(t)); });
  ASSERT_EQ(got.size(), static_cast<std::size_t>(count));
  for (int i = count / 4; i < count - 50 * static_cast<int>(std::ceil(0.001 / period)); ++i) {
    const auto& m = got[static_cast<std::size_t>(i)];
    EXPECT_NEAR(m.acceleration, kJerk * i * period, 1e-3 * kJerk * 0.2) << i;
    EXPECT_NEAR(m.jerk, kJerk, jerk_tolerance) << i;
  }
}

TEST(PathMotion, ConstantJerkOnALineIsExact) {
  const Vec3 direction = Vec3(1, 2, 2) / 3.0;
  for (const double period : {0.000125, 0.0005, 0.001, 0.004}) {
    expect_constant_jerk(
        period, [&](double s) { return Vec3(s * direction); }, 0.01);
  }
}

TEST(PathMotion, ConstantJerkOnATightCircleHasNoBiasOfTheChord) {
  expect_constant_jerk(
      0.001, [](double s) { return Vec3(std::cos(s), std::sin(s), 0.0); }, 0.002 * kJerk);
}

TEST(PathMotion, AStartAtFullFeedrateShowsAsAcceleration) {
  const auto got = motions(0.001, 100, [](double t) { return Vec3(50.0 * t, 0, 0); });
  EXPECT_NEAR(got.front().acceleration, 50.0 / 0.001, 1e-6);
  EXPECT_NEAR(got[50].acceleration, 0.0, 1e-6);
  EXPECT_NEAR(got.back().acceleration, -50.0 / 0.001, 1e-6);
}

TEST(PathMotion, ACornerAtConstantFeedrateShowsNoJerk) {
  constexpr double kFeedrate = 5.0;  // [mm/s]
  for (const double angle : {0.3, 0.8, 1.6, 2.5}) {
    const Vec3 after(std::cos(angle), std::sin(angle), 0.0);
    const auto got = motions(
        0.001, 400,
        [&](double t) {
          const double s = kFeedrate * (t - 0.2003);  // the corner lies within a period
          return s < 0.0 ? Vec3(s, 0.0, 0.0) : Vec3(s * after);
        },
        kFeedrate);
    for (std::size_t i = 20; i + 20 < got.size(); ++i) {
      ASSERT_NEAR(got[i].acceleration, 0.0, 20.0) << angle << " at " << i;
      ASSERT_NEAR(got[i].jerk, 0.0, 2000.0) << angle << " at " << i;
    }
  }
}

}  // namespace motion_filter_test
}  // namespace twin::pictures
