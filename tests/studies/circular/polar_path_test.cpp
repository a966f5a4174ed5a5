#include "studies/circular/polar_path.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "paths.hpp"

namespace twin::studies::circular {
namespace polar_path_test {

constexpr double kPi = std::numbers::pi;

TEST(PolarPath, AnglesAreWrappedIntoOneTurn) {
  EXPECT_DOUBLE_EQ(wrapped(-0.5 * kPi), 1.5 * kPi);
  EXPECT_DOUBLE_EQ(wrapped(5.0 * kPi), kPi);
  EXPECT_EQ(wrapped(0.0), 0.0);
  EXPECT_LT(wrapped(-1e-20), 2.0 * kPi);
}

TEST(PolarPath, RadiusIsLinearBetweenPointsAcrossZeroToo) {
  const std::vector<Vec2> square{{2.0, 0.0}, {0.0, 4.0}, {-2.0, 0.0}, {0.0, -4.0}};
  const PolarPath path(square, Vec2::Zero());
  EXPECT_DOUBLE_EQ(path.radius_at(0.0), 2.0);
  EXPECT_NEAR(path.radius_at(0.25 * kPi), 3.0, 1e-12);
  EXPECT_NEAR(path.radius_at(-0.25 * kPi), 3.0, 1e-12);
  EXPECT_NEAR(path.radius_at(-0.125 * kPi), 2.5, 1e-12);
  EXPECT_NEAR(path.radius_at(2.5 * kPi), 4.0, 1e-12);
}

TEST(PolarPath, SenseAndStartDoNotMatter) {
  const auto radius = [](double a) { return 20.0 + 0.01 * std::sin(5.0 * a); };
  const PolarPath there(test::path_of(radius), Vec2::Zero());
  const PolarPath back(test::path_of(radius, Sense::kClockwise), Vec2::Zero());
  for (double angle = 0.0; angle < 7.0; angle += 0.1) {
    EXPECT_NEAR(there.radius_at(angle), radius(angle), 1e-6);
    EXPECT_NEAR(back.radius_at(angle), radius(angle), 1e-6);
  }
}

}  // namespace polar_path_test
}  // namespace twin::studies::circular
