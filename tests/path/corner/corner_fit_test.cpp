#include "path/corner/corner_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/path/smooth_path.hpp"

// Passages of corners as parts of a path.
namespace twin::path {
namespace corner_fit_test {

Limits vector_limits() {
  Limits limits;
  limits.jerk_of = JerkOf::kVector;
  return limits;
}

std::vector<Segment> path_of(const std::vector<gcode::Block>& blocks, const Limits& limits,
                             CornerKind corners = CornerKind::kPassage) {
  PathSettings settings;
  settings.corners = corners;
  return test::smooth(blocks, settings, {}, limits);
}

const CornerMotion* passage_of(const Segment& segment) {
  return std::get_if<CornerMotion>(&segment.geometry);
}

long count_passages(const std::vector<Segment>& segments) {
  return std::count_if(segments.begin(), segments.end(),
                       [](const Segment& segment) { return passage_of(segment) != nullptr; });
}

std::vector<gcode::Block> any_walk(std::mt19937& random, double shortest, double longest) {
  return test::polyline(test::random_walk(random, 30, shortest, longest, 3.1));
}

TEST(CornerFit, ThePathIsSmoothAndWithinItsBoundsAndEveryBlockHasAMark) {
  std::mt19937 random(1);
  long found = 0;
  for (int i = 0; i < 40; ++i) {
    const double shortest = std::pow(10.0, -1.0 + 0.5 * (i % 4));
    const auto blocks = any_walk(random, shortest, 6.0 * shortest);
    const auto segments = path_of(blocks, vector_limits());
    found += count_passages(segments);
    ASSERT_NO_FATAL_FAILURE(test::expect_smooth_joints(segments)) << i;
    ASSERT_NO_FATAL_FAILURE(test::expect_marks(segments, static_cast<std::int64_t>(blocks.size())))
        << i;
    ASSERT_NO_FATAL_FAILURE(test::expect_within_bounds(segments, blocks, 0.01)) << i;
  }
  EXPECT_GT(found, 500);
}

// A plan between two passages is a ramp at least: it needs (v + w) / 2 times its time.
TEST(CornerFit, LinesBetweenPassagesHaveRoomForTheRamp) {
  std::mt19937 random(2);
  const Limits limits = vector_limits();
  for (int i = 0; i < 40; ++i) {
    const double shortest = std::pow(10.0, -1.0 + 0.5 * (i % 5));
    const auto segments = path_of(any_walk(random, shortest, 10.0 * shortest), limits);
    for (std::size_t k = 2; k < segments.size(); ++k) {
      const CornerMotion* const a = passage_of(segments[k - 2]);
      const CornerMotion* const b = passage_of(segments[k]);
      if (a == nullptr || b == nullptr || !test::is_line(segments[k - 1])) {
        continue;
      }
      const double change = std::abs(a->feedrate - b->feedrate);
      const double time = change < limits.acceleration * limits.acceleration / limits.jerk
                              ? 2.0 * std::sqrt(change / limits.jerk)
                              : change / limits.acceleration + limits.acceleration / limits.jerk;
      ASSERT_GE(segments[k - 1].length, 0.5 * (a->feedrate + b->feedrate) * time - 1e-9)
          << i << " segment " << k;
      ASSERT_GT(segments[k - 1].length, 0.0);
    }
  }
}

TEST(CornerFit, PassagesAreThereForTheVectorOfTheJerkOnlyAndWhereTheyAreAskedFor) {
  const auto blocks = test::polyline({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 0, 0}});
  EXPECT_EQ(count_passages(path_of(blocks, vector_limits())), 2);
  EXPECT_EQ(count_passages(path_of(blocks, vector_limits(), CornerKind::kCurve)), 0);
  EXPECT_EQ(count_passages(path_of(blocks, {})), 0);
}

TEST(CornerFit, TheLeastLimitsOfTheAxesThatMoveAreThoseOfThePassage) {
  Limits limits = vector_limits();
  limits.axis_jerk = {20000.0, 0.0, 1000.0};
  limits.axis_acceleration = {0.0, 900.0, 10.0};
  const auto segments = path_of(test::polyline({{0, 0, 0}, {20, 0, 0}, {20, 20, 0}}), limits);
  ASSERT_EQ(count_passages(segments), 1);
  EXPECT_EQ(passage_of(segments[1])->jerk, 20000.0);
  EXPECT_EQ(passage_of(segments[1])->acceleration, 900.0);
}

// Without a limit of its own, an axis would have any jerk in the passage.
TEST(CornerFit, UnderTheJerkOfThePathGentleCornersArePassedWhereAllAxesThatMoveHaveALimit) {
  const auto gentle = test::polyline({{0, 0, 0}, {20, 0, 0}, {40, 5, 0}});
  const auto sharp = test::polyline({{0, 0, 0}, {20, 0, 0}, {20, 20, 0}});
  Limits limits;
  limits.axis_jerk = {50000.0, 50000.0, 0.0};
  EXPECT_EQ(count_passages(path_of(gentle, limits)), 1);
  EXPECT_EQ(count_passages(path_of(sharp, limits)), 0);
  EXPECT_EQ(count_passages(path_of(gentle, limits, CornerKind::kCurve)), 0);
  limits.axis_jerk.y() = 0.0;
  EXPECT_EQ(count_passages(path_of(gentle, limits)), 0);
  limits.axis_jerk = {50000.0, 50000.0, 0.0};
  const auto rising = test::polyline({{0, 0, 0}, {20, 0, 0}, {40, 5, 1}});
  EXPECT_EQ(count_passages(path_of(rising, limits)), 0);
}

TEST(CornerFit, ABlockOfG61KeepsItsCornersAndStops) {
  auto blocks = test::polyline({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}});
  blocks[1].path_mode = gcode::PathMode::kExactStop;
  const auto segments = path_of(blocks, vector_limits());
  EXPECT_EQ(count_passages(segments), 0);
  EXPECT_TRUE(segments[0].stops_at_end && segments[1].stops_at_end);
}

}  // namespace corner_fit_test
}  // namespace twin::path
