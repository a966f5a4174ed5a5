#include <gtest/gtest.h>

#include "tests/support/blocks.hpp"

namespace twin::path {
namespace arc_segment_test {

constexpr double kPi = std::numbers::pi;

/// The definition in geometry/arc.hpp, word by word.
Vec3 defined_place(const geometry::Arc& g, double f) {
  const double a = f * g.sweep;
  return g.centre + (g.radius + f * g.radius_change) * (std::cos(a) * g.e1 + std::sin(a) * g.e2) +
         f * g.rise * g.e1.cross(g.e2);
}

/// Length of the polygon through `count` + 1 places from f = 0 to 1, Richardson-extrapolated.
double measured_length(const geometry::Arc& g, double f_end = 1.0) {
  const auto polygon = [&](int count) {
    double length = 0.0;
    for (int i = 0; i < count; ++i) {
      length +=
          (defined_place(g, f_end * (i + 1) / count) - defined_place(g, f_end * i / count)).norm();
    }
    return length;
  };
  return (4.0 * polygon(4000) - polygon(2000)) / 3.0;
}

geometry::Arc random_arc(std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const Vec3 e1 = Vec3(part(random) - 0.5, part(random) - 0.5, part(random) - 0.5).normalized();
  const Vec3 e2 = e1.cross(Vec3(part(random), part(random), 1.0 + part(random))).normalized();
  const double radius = std::pow(10.0, -1.0 + 3.0 * part(random));
  return {Vec3(part(random), part(random), part(random)),
          e1,
          e2,
          radius,
          radius * 0.01 * (part(random) - 0.5),
          0.05 + 6.2 * part(random),
          radius * 4.0 * (part(random) - 0.5)};
}

TEST(Arc, OfAFullCircleIsAsLongAsItsCircumference) {
  EXPECT_NEAR(make_arc({{1, 2, 3}, {1, 0, 0}, {0, 1, 0}, 7.0, 0.0, 2.0 * kPi, 0.0}).length,
              14.0 * kPi, 1e-13);
}

TEST(Arc, OfAHelixHasTheClosedFormsOfAHelix) {
  // r = 3, pitch h = 4 a radian: length = sweep 5, kappa = r / (r^2 + h^2) = 3/25.
  const Arc arc = make_arc({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3.0, 0.0, 2.0, 8.0});
  EXPECT_NEAR(arc.length, 10.0, 1e-13);
  for (double s = 0.0; s <= 10.0; s += 0.5) {
    const PathPoint at = point_at(arc, s);
    const double angle = s / 5.0;
    EXPECT_LT((at.position - Vec3(3 * std::cos(angle), 3 * std::sin(angle), 4 * angle)).norm(),
              1e-13);
    EXPECT_LT((at.tangent - Vec3(-0.6 * std::sin(angle), 0.6 * std::cos(angle), 0.8)).norm(),
              1e-14);
    EXPECT_LT((at.curvature + 0.12 * Vec3(std::cos(angle), std::sin(angle), 0.0)).norm(), 1e-14);
  }
}

TEST(Arc, TurningClockwiseDescendsWithNegativeAxis) {
  // e1 x e2 = -z: the rise along it goes down.
  const Arc arc = make_arc({{0, 0, 0}, {1, 0, 0}, {0, -1, 0}, 1.0, 0.0, kPi, 2.0});
  EXPECT_LT((point_at(arc, arc.length).position - Vec3(-1, 0, -2)).norm(), 1e-12);
}

TEST(Arc, WithChangingRadiusHasTheLengthOfItsPolygon) {
  std::mt19937 random(2);
  for (int i = 0; i < 40; ++i) {
    const geometry::Arc g = random_arc(random);
    const Arc arc = make_arc(g);
    EXPECT_NEAR(arc.length, measured_length(g), 2e-9 * arc.length);
  }
}

TEST(Arc, IsMeasuredByArcLengthAlongTheDefinedPlaces) {
  std::mt19937 random(3);
  for (int i = 0; i < 40; ++i) {
    const geometry::Arc g = random_arc(random);
    const Arc arc = make_arc(g);
    EXPECT_LT((point_at(arc, 0.0).position - defined_place(g, 0.0)).norm(), 1e-13 * g.radius);
    EXPECT_LT((point_at(arc, arc.length).position - defined_place(g, 1.0)).norm(),
              1e-12 * arc.length);
    const double s = measured_length(g, 0.37);
    EXPECT_LT((point_at(arc, s).position - defined_place(g, 0.37)).norm(), 1e-8 * arc.length);
  }
}

TEST(Arc, HasTangentAndCurvatureOfItsFiniteDifferences) {
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    const Arc arc = make_arc(random_arc(random));
    const double h = 1e-4 * arc.length;
    const double s = 0.31 * arc.length;
    const Vec3 before = point_at(arc, s - h).position;
    const PathPoint at = point_at(arc, s);
    const Vec3 after = point_at(arc, s + h).position;
    EXPECT_NEAR(at.tangent.norm(), 1.0, 1e-14);
    EXPECT_LT((at.tangent - (after - before) / (2.0 * h)).norm(), 1e-6);
    EXPECT_LT((at.curvature - (after - 2.0 * at.position + before) / (h * h)).norm() * arc.length,
              1e-4);
  }
}

TEST(Arc, StaysAtItsEndsBeyondThem) {
  const Arc arc = make_arc({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2.0, 1e-4, 1.0, 0.0});
  EXPECT_EQ(point_at(arc, -1.0).position, point_at(arc, 0.0).position);
  EXPECT_LT((point_at(arc, 9.0).position - point_at(arc, arc.length).position).norm(), 1e-14);
}

}  // namespace arc_segment_test
}  // namespace twin::path
