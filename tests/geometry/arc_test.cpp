#include "geometry/arc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace twin::geometry {
namespace arc_test {

Arc random_arc(std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const Vec3 e1 = Vec3(part(random) - 0.5, part(random) - 0.5, part(random) - 0.5).normalized();
  const Vec3 e2 = cross(e1, Vec3(part(random), part(random), 1.0 + part(random))).normalized();
  const double radius = std::pow(10.0, -1.0 + 3.0 * part(random));
  return {Vec3(part(random), part(random), part(random)),
          e1,
          e2,
          radius,
          radius * 0.01 * (part(random) - 0.5),
          0.05 + 6.2 * part(random),
          radius * 4.0 * (part(random) - 0.5)};
}

TEST(Arc, OfAQuarterTurnPassesItsMiddle) {
  const Arc arc{{1, 2, 3}, Vec3::UnitY(), -Vec3::UnitX(), 2.0, 0.0, std::numbers::pi / 2.0, 0.0};
  EXPECT_LT((point_at(arc, 0.0) - Vec3(1, 4, 3)).norm(), 1e-15);
  EXPECT_LT(
      (point_at(arc, 0.5) - Vec3(1.0 - std::numbers::sqrt2, 2.0 + std::numbers::sqrt2, 3)).norm(),
      1e-15);
  EXPECT_LT((point_at(arc, 1.0) - Vec3(-1, 2, 3)).norm(), 1e-15);
}

TEST(Arc, HasTheDerivativesOfItsFiniteDifferences) {
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    const Arc arc = random_arc(random);
    const double h = 1e-4;
    const Vec3 before = point_at(arc, 0.6 - h);
    const Derivatives at = derivatives_at(arc, 0.6);
    const Vec3 after = point_at(arc, 0.6 + h);
    const double scale = arc.radius * (1.0 + arc.sweep * arc.sweep * arc.sweep);
    EXPECT_EQ(at.position, point_at(arc, 0.6));
    EXPECT_LT((at.first - (after - before) / (2.0 * h)).norm(), 1e-7 * scale);
    EXPECT_LT((at.second - (after - 2.0 * at.position + before) / (h * h)).norm(), 1e-6 * scale);
    EXPECT_NEAR(speed_at(arc, 0.6), at.first.norm(), 1e-14 * scale);
  }
}

TEST(Arc, OfAHelixIsAsLongAsItsUnrolledTriangle) {
  const Arc helix{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3.0, 0.0, 2.0, 8.0};
  EXPECT_NEAR(length_to(helix, 1.0), 10.0, 1e-14);
  EXPECT_NEAR(length_to(helix, 0.3), 3.0, 1e-14);
}

TEST(Arc, FindsTheFractionWhoseLengthItIsGiven) {
  std::mt19937 random(12);
  for (int i = 0; i < 200; ++i) {
    const Arc arc = random_arc(random);
    const double length = length_to(arc, 1.0);
    for (const double fraction : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      EXPECT_NEAR(fraction_at(arc, length_to(arc, fraction), length), fraction, 1e-13);
    }
  }
}

TEST(Arc, ClampsTheArcLengthToItsEnds) {
  const Arc arc{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2.0, 1e-4, 1.0, 0.0};
  EXPECT_EQ(fraction_at(arc, -1.0, length_to(arc, 1.0)), 0.0);
  EXPECT_EQ(fraction_at(arc, 9.0, length_to(arc, 1.0)), 1.0);
}

TEST(Arc, HasPartsThatLieOnIt) {
  std::mt19937 random(13);
  for (int i = 0; i < 200; ++i) {
    const Arc arc = random_arc(random);
    const Arc part = part_of(arc, 0.2, 0.7);
    for (const double f : {0.0, 0.3, 1.0}) {
      EXPECT_LT((point_at(part, f) - point_at(arc, 0.2 + 0.5 * f)).norm(),
                1e-13 * arc.radius + 1e-14);
    }
    EXPECT_NEAR(length_to(part, 1.0), length_to(arc, 0.7) - length_to(arc, 0.2), 1e-9 * arc.radius);
  }
}

}  // namespace arc_test
}  // namespace twin::geometry
