#include "geometry/smoothing/chord_deviation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace twin::geometry {
namespace chord_deviation_test {

double distance_to_chord(const Vec3& p, const Polygon& polygon, std::size_t i) {
  const double length = polygon[i + 1].s - polygon[i].s;
  const double along = std::clamp((p - polygon[i].at).dot(polygon[i].direction), 0.0, length);
  return (p - polygon[i].at - along * polygon[i].direction).norm();
}

TEST(ChordDeviation, BoundsTheDistanceOfRandomCubicsBothWays) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  const auto vector = [&](double size) {
    return Vec3(size * part(random), size * part(random), size * part(random));
  };
  for (int trial = 0; trial < 300; ++trial) {
    Polygon polygon;
    Vec3 at = Vec3::Zero();
    polygon.start(at, 0.0);
    for (int i = 0; i < 5; ++i) {
      polygon.push(at += Vec3(0.3 + 0.2 * part(random), 0.1 * part(random), 0.0));
    }
    const double end = polygon[5].s;
    const geometry::SpanCubic cubic{
        0.0, end, vector(0.1), Vec3(1, 0, 0) + vector(0.3), vector(0.2), vector(0.1)};
    const Deviation bound = chord_deviation(cubic, polygon, 0, 4);
    double largest = 0.0;
    std::array<double, 6> from_program{};
    from_program.fill(1e9);
    for (int k = 0; k <= 2000; ++k) {
      const Vec3 p = cubic.position(end * k / 2000.0);
      double nearest = 1e9;
      for (std::size_t i = 0; i < 5; ++i) {
        nearest = std::min(nearest, distance_to_chord(p, polygon, i));
        from_program[i] =
            std::min(from_program[i], (p - 0.5 * (polygon[i].at + polygon[i + 1].at)).norm());
      }
      largest = std::max(largest, nearest);
    }
    EXPECT_LE(largest, bound.bound);
    EXPECT_LE(*std::max_element(from_program.begin(), from_program.begin() + 5),
              bound.bound + 1e-3);
  }
}

TEST(ChordDeviation, IsTightOnAParabolaOverItsChord) {
  Polygon polygon;
  polygon.start({0, 0, 0}, 0.0);
  polygon.push({1, 0, 0});
  // y = 0.04 x (1 - x): 0.01 high, its inner Bezier points 0.04 / 3.
  const geometry::SpanCubic cubic{0.0, 1.0, {0, 0, 0}, {1, 0.04, 0}, {0, -0.04, 0}, {0, 0, 0}};
  EXPECT_NEAR(chord_deviation(cubic, polygon, 0, 0).bound, 0.04 / 3.0, 1e-15);
}

TEST(ChordDeviation, NamesTheWorstBlock) {
  Polygon polygon;
  polygon.start({0, 0, 0}, 0.0);
  for (const Vec3& p : {Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0.2, 0)}) {
    polygon.push(p);
  }
  const geometry::SpanCubic line{0.0, polygon[3].s, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(chord_deviation(line, polygon, 0, 2).block, 2U);
}

}  // namespace chord_deviation_test
}  // namespace twin::geometry
