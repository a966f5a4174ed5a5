#include "studies/circular/circle_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "paths.hpp"

namespace twin::studies::circular {
namespace circle_fit_test {

using test::path_of;

/// Width of the ring about a centre that holds all points [mm].
double ring_width(const std::vector<Vec2>& path, const Vec2& centre) {
  double least = 1e9;
  double largest = 0.0;
  for (const Vec2& point : path) {
    least = std::min(least, (point - centre).norm());
    largest = std::max(largest, (point - centre).norm());
  }
  return largest - least;
}

/// A rough path: harmonics 2 to 9 of random size, some um in all.
std::vector<Vec2> rough_path(std::mt19937& random, const Vec2& centre) {
  std::normal_distribution<double> size(0.0, 2e-3);
  std::array<double, 16> a{};
  std::ranges::generate(a, [&] { return size(random); });
  return path_of(
      [&](double angle) {
        double radius = 20.0;
        for (int k = 2; k < 10; ++k) {
          const auto i = static_cast<std::size_t>(2 * (k - 2));
          radius += a[i] * std::cos(k * angle) + a[i + 1] * std::sin(k * angle);
        }
        return radius;
      },
      Sense::kCounterClockwise, centre, 720);
}

TEST(LeastSquaresCircle, FindsAShiftedCircleExactly) {
  const Vec2 centre(0.3, -1.2);
  const Circle circle =
      least_squares_circle(path_of([](double) { return 7.5; }, Sense::kClockwise, centre));
  EXPECT_NEAR((circle.centre - centre).norm(), 0.0, 1e-12);
  EXPECT_NEAR(circle.radius, 7.5, 1e-12);
}

TEST(LeastSquaresCircle, HasTheMeanRadiusOfLobes) {
  const Circle circle =
      least_squares_circle(path_of([](double a) { return 20.0 + 0.004 * std::cos(3.0 * a); }));
  EXPECT_NEAR(circle.centre.norm(), 0.0, 1e-9);
  EXPECT_NEAR(circle.radius, 20.0, 1e-9);
}

TEST(LeastSquaresCircle, NoOtherCircleHasLessSquares) {
  std::mt19937 random(7);
  const auto path = rough_path(random, {0.002, 0.005});
  const Circle best = least_squares_circle(path);
  const auto squares = [&](const Circle& c) {
    double sum = 0.0;
    for (const Vec2& point : path) {
      sum += std::pow((point - c.centre).norm() - c.radius, 2);
    }
    return sum;
  };
  std::normal_distribution<double> off(0.0, 1e-4);
  for (int i = 0; i < 100; ++i) {
    const Circle other{best.centre + Vec2(off(random), off(random)), best.radius + off(random)};
    EXPECT_LE(squares(best), squares(other));
  }
}

TEST(MinimumZone, OfAShiftedCircleIsNothing) {
  const MinimumZone zone =
      minimum_zone(path_of([](double) { return 20.0; }, Sense::kCounterClockwise, {0.010, -0.004}));
  EXPECT_NEAR(zone.separation, 0.0, 1e-9);
}

TEST(MinimumZone, OfAnEllipseIsTheDifferenceOfItsHalfAxes) {
  const auto path = path_of(
      [](double a) { return 1.0 / std::hypot(std::cos(a) / 20.010, std::sin(a) / 19.998); });
  EXPECT_NEAR(minimum_zone(path).separation, 0.012, 1e-7);
}

TEST(MinimumZone, OfAShiftedThreeLobedPathIsTwiceTheLobe) {
  const Vec2 centre(0.02, 0.03);
  const auto path =
      path_of([](double a) { return 20.0 + 0.005 * std::cos(3.0 * a); }, Sense::kClockwise, centre);
  const MinimumZone zone = minimum_zone(path);
  EXPECT_NEAR(zone.separation, 0.010, 1e-7);
  EXPECT_NEAR((zone.centre - centre).norm(), 0.0, 1e-5);
}

constexpr double kSecondOrder = 2e-6;  // |d|^2 / r for centres some um off [mm]

TEST(MinimumZone, IsWidthOfItsRingAndNoOtherCentreHasANarrowerOne) {
  std::mt19937 random(3);
  std::normal_distribution<double> off(0.0, 1e-3);
  for (int shape = 0; shape < 5; ++shape) {
    const auto path = rough_path(random, {0.003, -0.001});
    const MinimumZone zone = minimum_zone(path);
    EXPECT_NEAR(ring_width(path, zone.centre), zone.separation, kSecondOrder);
    EXPECT_LE(zone.separation, ring_width(path, least_squares_circle(path).centre) + kSecondOrder);
    for (int i = 0; i < 500; ++i) {
      const Vec2 other = zone.centre + Vec2(off(random), off(random));
      EXPECT_GE(ring_width(path, other), zone.separation - kSecondOrder);
    }
  }
}

}  // namespace circle_fit_test
}  // namespace twin::studies::circular
