#include "geometry/smoothing/quasi_interpolant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace twin::geometry {
namespace quasi_interpolant_test {

/// The spans of the spline through a whole run.
std::vector<SpanCubic> spline_of(const Polygon& polygon, double tolerance) {
  const std::size_t end = polygon.last();
  const KnownRun run{{&polygon, 0, end - 1, polygon[0].s, polygon[end].s}, true};
  KnotMarcher knots;
  QuasiInterpolant interpolant(knots);
  knots.start(tolerance);
  knots.begin_at(polygon[0].s, 0);
  interpolant.begin_at(polygon[0].at);
  while (!knots.is_marched(run)) {
    knots.march(run);
    interpolant.extend(run);
  }
  std::vector<SpanCubic> spans;
  for (std::size_t span = 0; span < knots.last(); ++span) {
    spans.push_back(interpolant.cubic(span));
  }
  return spans;
}

Polygon circle(double radius, int blocks) {
  Polygon polygon;
  polygon.start(Vec3(radius, 0.0, 0.0), 0.0);
  for (int i = 1; i <= blocks; ++i) {
    polygon.push(radius * Vec3(std::cos(0.01 * i), std::sin(0.01 * i), 0.0));
  }
  return polygon;
}

TEST(QuasiInterpolant, OfPointsOnALineIsTheLine) {
  Polygon polygon;
  polygon.start(Vec3(1.0, 2.0, 3.0), 0.0);
  for (int i = 1; i <= 50; ++i) {
    polygon.push(Vec3(1.0, 2.0, 3.0) + 0.3 * i * Vec3(2.0, -1.0, 2.0) / 3.0);
  }
  for (const SpanCubic& span : spline_of(polygon, 0.01)) {
    for (const double s : {span.begin, 0.5 * (span.begin + span.end), span.end}) {
      EXPECT_LT((span.position(s) - Vec3(1, 2, 3) - s * Vec3(2, -1, 2) / 3.0).norm(), 1e-12);
    }
  }
}

TEST(QuasiInterpolant, EndsInTheRunsEndsWithoutCurvature) {
  const Polygon polygon = circle(10.0, 200);
  const std::vector<SpanCubic> spans = spline_of(polygon, 0.001);
  EXPECT_LT((spans.front().position(spans.front().begin) - polygon[0].at).norm(), 1e-12);
  EXPECT_LT((spans.back().position(spans.back().end) - polygon[200].at).norm(), 1e-12);
  EXPECT_LT(spans.front().second(spans.front().begin).norm(), 1e-10);
  EXPECT_LT(spans.back().second(spans.back().end).norm(), 1e-10);
}

TEST(QuasiInterpolant, HasTwoContinuousDerivatives) {
  const std::vector<SpanCubic> spans = spline_of(circle(10.0, 200), 0.001);
  ASSERT_GE(spans.size(), 3U);
  for (std::size_t i = 1; i < spans.size(); ++i) {
    const SpanCubic& a = spans[i - 1];
    const double t = a.end - a.begin;
    EXPECT_LT((a.position(a.end) - spans[i].c0).norm(), 1e-12);
    EXPECT_LT((a.c1 + t * (2.0 * a.c2 + 3.0 * t * a.c3) - spans[i].c1).norm(), 1e-12);
    EXPECT_LT((a.second(a.end) - 2.0 * spans[i].c2).norm(), 1e-11);
  }
}

TEST(QuasiInterpolant, LiesOnTheRoundThatThePointsAreOf) {
  const std::vector<SpanCubic> spans = spline_of(circle(10.0, 200), 0.001);
  for (const SpanCubic& span : spans) {
    if (span.begin > 5.0 && span.end < 15.0) {
      EXPECT_NEAR(span.position(0.5 * (span.begin + span.end)).norm(), 10.0, 1.5e-4);
      EXPECT_NEAR(span.second(0.5 * (span.begin + span.end)).norm(), 0.1, 0.002);
    }
  }
}

}  // namespace quasi_interpolant_test
}  // namespace twin::geometry
