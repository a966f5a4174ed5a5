#include "motion/interpolator/interpolator.hpp"

#include <gtest/gtest.h>

#include "following.hpp"
#include "tests/support/blocks.hpp"
#include "tests/support/random_program.hpp"

namespace twin::motion {
namespace interpolator_test {

using test::follow;
using test::mixed_plan;
using test::place_at;
using test::PlanSource;

constexpr double kPeriods[] = {0.125e-3, 0.25e-3, 1e-3, 2e-3, 4e-3};

/// The plan asked for its place every period, to its end, rounded up to a period.
void expect_places_of_plan(const std::vector<SetPoint>& points, const test::Plan& plan,
                           double period) {
  const double periods = plan.time / period;
  ASSERT_GE(static_cast<double>(points.size() - 1), periods - 1e-6);
  ASSERT_LE(static_cast<double>(points.size() - 1), periods + 1.0 + 1e-6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 expected = place_at(plan, static_cast<double>(i) * period);
    ASSERT_LT((points[i].position - expected).norm(), 1e-8) << "set point " << i;
  }
  ASSERT_LT((points.back().position - plan.segments.back().segment.end.position).norm(), 1e-8);
  ASSERT_EQ(points.back().velocity.norm(), 0.0);
}

TEST(Interpolator, GivesThePlacesOfThePlanAtEveryPeriodAcrossSegmentEnds) {
  for (const double period : kPeriods) {
    const auto plan = mixed_plan(period);
    expect_places_of_plan(follow(plan, period), plan, period);
  }
}

TEST(Interpolator, GivesThePlacesOfThePlanOfRandomPrograms) {
  std::mt19937 random(1);
  for (int i = 0; i < 25; ++i) {
    test::PlanSettings settings;
    settings.period = kPeriods[i % 5] * (i % 5 == 0 ? 4.0 : 1.0);
    const auto blocks = test::random_program(random, 6);
    const auto plan = test::plan(blocks, settings);
    ASSERT_NO_FATAL_FAILURE(
        expect_places_of_plan(follow(plan, settings.period), plan, settings.period))
        << "program " << i;
  }
}

TEST(Interpolator, TakesNoShortStepOnALineInPiecesShorterThanAStep) {
  // 0.013 mm pieces, 0.05 mm a period: at full feedrate every step is v T.
  std::vector<path::Segment> pieces;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 start(0.013 * i, 0.0, 0.0);
    pieces.push_back(
        path::make_segment(test::line_block(start, start + Vec3(0.013, 0, 0)), i, {}, {}));
  }
  const auto points = follow(test::plan(pieces), 1e-3);
  int at_feedrate = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].feedrate > 50.0 - 1e-9 && points[i - 1].feedrate > 50.0 - 1e-9) {
      EXPECT_NEAR((points[i].position - points[i - 1].position).norm(), 0.05, 1e-9);
      ++at_feedrate;
    }
  }
  EXPECT_GT(at_feedrate, 300);
}

TEST(Interpolator, StarvedStepsChangeNothing) {
  for (const double period : {0.5e-3, 4e-3}) {
    const auto plan = mixed_plan(period);
    const auto points = follow(plan, period);
    for (const std::size_t every : {2U, 3U, 7U}) {
      const auto starved = follow(plan, period, every);
      ASSERT_EQ(starved.size(), points.size());
      for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_LT((starved[i].position - points[i].position).norm(), 1e-9);
        ASSERT_EQ(starved[i].block, points[i].block);
      }
    }
  }
}

TEST(Interpolator, ReleasesEverySegmentOnceAndInOrder) {
  const auto plan = mixed_plan(1e-3);
  PlanSource source(plan);
  {
    Interpolator interpolator(source, 1e-3);
    SetPoint point;
    while (interpolator.step(point) != Status::kDone) {
    }
  }
  EXPECT_EQ(source.released(), plan.segments.size());
}

TEST(Interpolator, StaysWhereItIsDuringADwell) {
  const auto plan = mixed_plan(1e-3);
  const auto points = follow(plan, 1e-3);
  std::int64_t rest = 0;
  for (const auto& planned : plan.segments) {
    rest = planned.segment.dwell > 0.0 ? planned.index : rest;
  }
  int resting = 0;
  for (const SetPoint& point : points) {
    if (point.segment == rest) {
      ++resting;
      EXPECT_EQ(point.velocity.norm(), 0.0);
      EXPECT_EQ(point.acceleration.norm(), 0.0);
    }
  }
  EXPECT_NEAR(resting, 50, 1);
}

TEST(Interpolator, NamesBlocksAndSegmentsInOrder) {
  const auto plan = mixed_plan(1e-3);
  const auto points = follow(plan, 1e-3);
  EXPECT_EQ(points.front().block, 0);
  EXPECT_EQ(points.back().block, plan.segments.back().segment.marks.back().block);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_GE(points[i].block, points[i - 1].block);
    EXPECT_GE(points[i].segment, points[i - 1].segment);
  }
}

TEST(Interpolator, OfNothingIsDoneAtOnce) {
  const test::Plan empty;
  EXPECT_TRUE(follow(empty, 1e-3).empty());
}

}  // namespace interpolator_test
}  // namespace twin::motion
