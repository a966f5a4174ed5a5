#include "geometry/smoothing/polygon.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twin::geometry {
namespace polygon_test {

Polygon circle(double radius, double step, int count) {
  Polygon polygon;
  polygon.start({radius, 0.0, 0.0}, 0.0);
  for (int i = 1; i <= count; ++i) {
    polygon.push({radius * std::cos(i * step), radius * std::sin(i * step), 0.0});
  }
  return polygon;
}

TEST(Polygon, AimsHalfASagittaToEitherSideOfACirclesChords) {
  const double radius = 10.0;
  const double step = 0.05;
  const Polygon polygon = circle(radius, step, 20);
  const double sagitta = radius * (1.0 - std::cos(0.5 * step));
  for (std::size_t i = 3; i < 15; ++i) {
    EXPECT_NEAR(polygon[i].aim.norm(), radius - 0.5 * sagitta, 1e-3 * sagitta);
    const double middle = 0.5 * (polygon[i].s + polygon[i + 1].s);
    EXPECT_NEAR(polygon.aim(i, middle).norm(), radius - 0.5 * sagitta, 1e-3 * sagitta);
  }
}

TEST(Polygon, AimsAtAStraightLineItself) {
  Polygon polygon;
  polygon.start({0, 0, 0}, 5.0);
  for (const double x : {0.1, 0.5, 0.6, 3.0, 3.1}) {
    polygon.push({x, 2.0 * x, -x});
  }
  for (std::size_t i = 0; i < polygon.last(); ++i) {
    const double s = 0.3 * polygon[i].s + 0.7 * polygon[i + 1].s;
    EXPECT_LT((polygon.aim(i, s) - (s - 5.0) * polygon[0].direction).norm(), 1e-14);
  }
}

TEST(Polygon, LeavesABlockBesideASingleKinkStraight) {
  Polygon polygon;
  polygon.start({0, 0, 0}, 0.0);
  for (const Vec3& point : {Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0.1, 0), Vec3(4, 0.2, 0)}) {
    polygon.push(point);
  }
  for (std::size_t i = 0; i < polygon.last(); ++i) {
    EXPECT_EQ(polygon[i].bulge, Vec3::Zero()) << i;
  }
}

TEST(Polygon, FindsTheBlockFromEitherSide) {
  const Polygon polygon = circle(10.0, 0.1, 30);
  for (const std::size_t from : {0, 12, 29}) {
    EXPECT_EQ(polygon.block_at(polygon[12].s, from, 0, 29), 12U);
    EXPECT_EQ(polygon.block_at(polygon[12].s + 0.4, from, 0, 29), 12U);
    EXPECT_EQ(polygon.block_at(1e9, from, 0, 29), 29U);
  }
}

}  // namespace polygon_test
}  // namespace twin::geometry
