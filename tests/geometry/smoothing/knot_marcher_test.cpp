#include "geometry/smoothing/knot_marcher.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twin::geometry {
namespace knot_marcher_test {

Polygon circle(double radius, double chord, int blocks) {
  Polygon polygon;
  polygon.start(Vec3(radius, 0.0, 0.0), 0.0);
  for (int i = 1; i <= blocks; ++i) {
    const double angle = 2.0 * std::asin(0.5 * chord / radius) * i;
    polygon.push(Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.0));
  }
  return polygon;
}

KnownRun closed_run(const Polygon& polygon) {
  const std::size_t end = polygon.last();
  return {{&polygon, 0, end - 1, polygon[0].s, polygon[end].s}, true};
}

KnotMarcher marched(const KnownRun& run, double tolerance) {
  KnotMarcher knots;
  knots.start(tolerance);
  knots.begin_at(run.stretch.begin, 0);
  while (!knots.is_marched(run)) {
    EXPECT_TRUE(knots.can_march(run));
    knots.march(run);
  }
  return knots;
}

TEST(KnotMarcher, EndsExactlyAtTheEndOfTheRun) {
  const Polygon polygon = circle(20.0, 0.1, 400);
  const KnownRun run = closed_run(polygon);
  const KnotMarcher knots = marched(run, 0.01);
  EXPECT_EQ(knots.at(knots.last()), run.stretch.end);
  for (std::size_t j = 1; j <= knots.last(); ++j) {
    EXPECT_GT(knots.at(j), knots.at(j - 1));
    EXPECT_LE(polygon[knots.block(j)].s, knots.at(j));
  }
}

TEST(KnotMarcher, GrowsToNoMoreThanTwiceTheSpanBefore) {
  const Polygon polygon = circle(20.0, 0.1, 400);
  const KnotMarcher knots = marched(closed_run(polygon), 0.01);
  for (std::size_t j = 2; j <= knots.last(); ++j) {
    EXPECT_LE(knots.at(j) - knots.at(j - 1), 2.0 * (knots.at(j - 1) - knots.at(j - 2)) + 1e-9);
  }
}

TEST(KnotMarcher, MakesLongerSpansForALargerTolerance) {
  const Polygon polygon = circle(20.0, 0.1, 400);
  const KnownRun run = closed_run(polygon);
  EXPECT_LT(marched(run, 0.1).last(), marched(run, 0.0001).last());
}

TEST(KnotMarcher, ReflectsItsKnotsBeyondBothEnds) {
  const Polygon polygon = circle(20.0, 0.1, 400);
  const KnotMarcher knots = marched(closed_run(polygon), 0.01);
  const auto last = static_cast<std::ptrdiff_t>(knots.last());
  ASSERT_GE(last, 2);
  for (std::ptrdiff_t j = 0; j <= 2; ++j) {
    EXPECT_DOUBLE_EQ(knots.reflected(-j) + knots.reflected(j), 2.0 * knots.reflected(0));
    EXPECT_DOUBLE_EQ(knots.reflected(last + j) + knots.reflected(last - j),
                     2.0 * knots.reflected(last));
  }
}

TEST(KnotMarcher, HalvesASpanThatIsMarchedAgain) {
  const Polygon polygon = circle(20.0, 0.1, 400);
  const KnownRun run = closed_run(polygon);
  KnotMarcher knots = marched(run, 0.01);
  const double width = knots.at(1) - knots.at(0);
  knots.shorten(0);
  EXPECT_DOUBLE_EQ(knots.shortened_until(), knots.at(0) + 2.0 * width);
  knots.truncate(0);
  knots.march(run);
  EXPECT_LE(knots.at(1) - knots.at(0), 0.5 * width + 1e-12);
}

TEST(KnotMarcher, WaitsUntilEnoughOfAGrowingRunIsKnown) {
  const Polygon polygon = circle(20.0, 0.1, 20);
  KnownRun run = closed_run(polygon);
  run.is_closed = false;
  KnotMarcher knots;
  knots.start(0.01);
  knots.begin_at(0.0, 0);
  EXPECT_FALSE(knots.can_march(run));
  run.is_closed = true;
  EXPECT_TRUE(knots.can_march(run));
}

}  // namespace knot_marcher_test
}  // namespace twin::geometry
