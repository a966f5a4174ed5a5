#include "pictures/plot/normal_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace twin::pictures {
namespace normal_error_test {

Vec2 on_circle(double radius, double angle) {
  return {3.0 + radius * std::cos(angle), -2.0 + radius * std::sin(angle)};
}

TEST(NormalError, ALagOnACircleIsNoError) {
  for (const double sense : {1.0, -1.0}) {
    for (const double radius : {0.5, 2.0, 100.0}) {
      const auto at = [&](double arc) { return on_circle(radius, 0.7 + sense * arc / radius); };
      const Vec2 error = normal_error(at(-0.04), at(0.0), at(0.05), at(-0.2));
      EXPECT_NEAR(error.norm(), 0.0, 1e-10) << radius;
    }
  }
}

TEST(NormalError, OnACircleItIsTheDistanceToTheCircleWithItsSide) {
  const auto at = [](double arc) { return on_circle(2.0, arc / 2.0); };
  const Vec2 outside = on_circle(2.03, -0.1);
  const Vec2 error = normal_error(at(-0.05), at(0.0), at(0.05), outside);
  EXPECT_NEAR(error.x(), 0.03 * std::cos(-0.1), 1e-10);
  EXPECT_NEAR(error.y(), 0.03 * std::sin(-0.1), 1e-10);
}

TEST(NormalError, OnALineItIsTheSquarePart) {
  const Vec2 error = normal_error({0, 0}, {1, 1}, {2, 2}, {1.5, 1.4});
  EXPECT_NEAR(error.x(), 0.05, 1e-12);
  EXPECT_NEAR(error.y(), -0.05, 1e-12);
}

TEST(NormalError, AtTheEndsOfThePathTheOnlyChordIsTheDirection) {
  const Vec2 error = normal_error({0, 0}, {0, 0}, {1, 0}, {0.5, 0.1});
  EXPECT_NEAR(error.x(), 0.0, 1e-12);
  EXPECT_NEAR(error.y(), 0.1, 1e-12);
}

TEST(NormalError, AtRestThereIsNone) {
  EXPECT_EQ(normal_error({1, 1}, {1, 1}, {1, 1}, {2, 3}), Vec2(0, 0));
}

}  // namespace normal_error_test
}  // namespace twin::pictures
