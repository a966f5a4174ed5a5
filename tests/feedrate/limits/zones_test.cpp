#include "feedrate/limits/zones.hpp"

#include <gtest/gtest.h>

#include "feedrate/limits/feedrate_rules.hpp"
#include "tests/support/blocks.hpp"

namespace twin::feedrate {
namespace zones_test {

using test::build;
using test::polyline;

const Limits kLimits;
const PlanningModel kModel;

/// By the paper's rules.
std::vector<LimitZone> zones_of(const path::Segment& segment, double s0 = 0.0) {
  std::vector<LimitZone> zones;
  PathSettings paper;
  paper.planner = Planner::kPaper;
  append_segment_limits(segment, s0, segment.feedrate, {kLimits, kModel, paper, 1e-3}, zones);
  return zones;
}

/// An outline with tight rounds: r = 5 + cos(4 a), its curvature goes up to about 1 1/mm.
std::vector<path::Segment> curves() {
  std::vector<Vec3> points;
  for (int i = 0; i <= 500; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 500.0;
    const double r = 5.0 + 0.9 * std::cos(4.0 * a);
    points.emplace_back(r * std::cos(a), r * std::sin(a), 0.0);
  }
  return build(polyline(points, 100.0));
}

TEST(SegmentLimits, OfALineIsItsFeedrate) {
  const auto zones =
      zones_of(path::make_segment(test::line_block({0, 0, 0}, {3, 4, 0}, 42.0), 0, {}, {}), 7.0);
  ASSERT_EQ(zones.size(), 1U);
  EXPECT_EQ(zones[0].begin, 7.0);
  EXPECT_EQ(zones[0].end, 12.0);
  EXPECT_EQ(zones[0].limit, 42.0);
}

TEST(SegmentLimits, OfAnArcIsThatOfItsCurvature) {
  const auto zones = zones_of(
      path::make_segment(test::arc_block({0, 0, 0}, {1, 0, 0}, 0.5, 2.0, true, 100.0), 0, {}, {}));
  ASSERT_EQ(zones.size(), 1U);
  EXPECT_NEAR(zones[0].limit, curvature_feedrate(2.0, 100.0, kModel, kLimits), 1e-9);
  EXPECT_LT(zones[0].limit, 35.0);
}

TEST(SegmentLimits, OfACurveCoverItWithoutAGap) {
  for (const path::Segment& segment : curves()) {
    const auto zones = zones_of(segment, 3.0);
    EXPECT_EQ(zones.front().begin, 3.0);
    EXPECT_NEAR(zones.back().end, 3.0 + segment.length, 1e-9);
    for (std::size_t i = 1; i < zones.size(); ++i) {
      EXPECT_EQ(zones[i].begin, zones[i - 1].end);
    }
  }
}

TEST(SegmentLimits, OfACurveHoldAtEveryDenselySampledPlace) {
  double lowest = 1e9;
  double highest = 0.0;
  for (const path::Segment& segment : curves()) {
    const auto& fitted = std::get<path::FittedCurve>(segment.geometry);
    for (const LimitZone& zone : zones_of(segment)) {
      lowest = std::min(lowest, zone.limit);
      highest = std::max(highest, zone.limit);
      for (int i = 0; i <= 10; ++i) {
        const double s = zone.begin + 0.1 * i * (zone.end - zone.begin);
        const double u = fitted.arc_length.u_at(fitted.curve, s, 0.0);
        const double k = path::point_from(fitted.curve.derivatives(u)).curvature.norm();
        // Between two samples of one zone the curvature may be higher than at both by a little.
        EXPECT_LE(k * zone.limit * zone.limit, 1.02 * kLimits.acceleration);
      }
    }
  }
  EXPECT_LT(lowest, 0.5 * highest);
}

TEST(SegmentLimits, ActWhereTheCurvatureIs) {
  // One zone never binds a whole curve whose curvature differs by more than a fifth along it.
  for (const path::Segment& segment : curves()) {
    double low = 1e9;
    double high = 0.0;
    for (const auto& sample : std::get<path::FittedCurve>(segment.geometry).curvature) {
      const double limit = curvature_feedrate(sample.curvature, 100.0, kModel, kLimits);
      low = std::min(low, limit);
      high = std::max(high, limit);
    }
    const auto zones = zones_of(segment);
    double best = 0.0;
    for (const LimitZone& zone : zones) {
      best = std::max(best, zone.limit);
    }
    EXPECT_GE(best, 0.9 * high);
    if (high > 1.2 * low) {
      EXPECT_GT(zones.size(), 3U);
    }
  }
}

TEST(CurvatureNearEnd, IsTheLargestWithinTheDistance) {
  for (const path::Segment& segment : curves()) {
    const auto& samples = std::get<path::FittedCurve>(segment.geometry).curvature;
    for (const double distance : {0.0, 0.1, 0.3, 100.0}) {
      double begin = segment.begin.curvature.norm();
      double end = segment.end.curvature.norm();
      for (const auto& sample : samples) {
        begin = sample.s <= distance ? std::max(begin, sample.curvature) : begin;
        end = segment.length - sample.s <= distance ? std::max(end, sample.curvature) : end;
      }
      EXPECT_EQ(curvature_near(SegmentEnd::kBegin, segment, distance), begin);
      EXPECT_EQ(curvature_near(SegmentEnd::kEnd, segment, distance), end);
    }
  }
}

}  // namespace zones_test
}  // namespace twin::feedrate
