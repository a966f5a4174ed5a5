#include "results/metrics/contour_tracker.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <vector>

#include "blocks.hpp"

namespace twin::results {
namespace contour_tracker_test {

constexpr double kPi = std::numbers::pi;

void add_polyline(ContourTracker& tracker, const std::vector<Vec3>& points) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    tracker.add(line(points[i - 1], points[i]));
  }
}

TEST(ContourTracker, OffsetFromALineIsTheErrorAndLagIsNot) {
  ContourTracker tracker(View::kAlongZ);
  tracker.add(line({0, 0, 0}, {100, 0, 0}));
  for (double x = 0; x <= 100; x += 0.7) {
    tracker.follow(0, {x, 0, 0});
    const double lag = std::min(x, 2.0);
    EXPECT_NEAR(tracker.nearest({x - lag, 0.013, 5}).distance, 0.013, 1e-12);
    EXPECT_NEAR(tracker.nearest({x, 0, 0}).distance, 0.0, 1e-12);
  }
}

TEST(ContourTracker, OffsetFromACircleIsTheErrorOnItsFirstAndSecondTurn) {
  ContourTracker tracker(View::kSpace);
  tracker.add(line({0, 0, 0}, {10, 0, 0}));
  tracker.add(arc({10, 0, 0}, {0, 0, 0}, {0, 0, 1}, 2 * kPi));
  tracker.add(arc({10, 0, 0}, {0, 0, 0}, {0, 0, 1}, 2 * kPi));
  for (std::int64_t turn : {0, 1}) {
    for (int i = 0; i <= 2000; ++i) {
      const double a = 2 * kPi * i / 2000;
      tracker.follow(1 + turn, {10 * std::cos(a), 10 * std::sin(a), 0});
      const Vec3 outside(10.02 * std::cos(a - 0.02), 10.02 * std::sin(a - 0.02), 0.0);
      if (turn == 1 || i > 100) {
        EXPECT_NEAR(tracker.nearest(outside).distance, 0.02, 1e-10);
      }
    }
  }
}

TEST(ContourTracker, ClosedCircleStartsAtItsStart) {
  ContourTracker tracker(View::kAlongZ);
  tracker.add(line({20, -5, 0}, {20, 0, 0}));
  tracker.add(arc({20, 0, 0}, {0, 0, 0}, {0, 0, 1}, 2 * kPi));
  tracker.add(line({20, 0, 0}, {30, 0, 0}));
  for (double y = -5; y < 0; y += 0.05) {
    tracker.follow(0, {20, y, 0});
  }
  tracker.follow(1, {20 * std::cos(0.001), 20 * std::sin(0.001), 0});
  // still on the approach by tracking error; the line after the circle is not meant
  EXPECT_NEAR(tracker.nearest({20, -0.3, 0}).distance, 0.0, 1e-12);
  EXPECT_NEAR(tracker.nearest({20.4, 0.0, 0}).distance, 0.4, 1e-9);
}

TEST(ContourTracker, NeighbouringLegDoesNotHideAnError) {
  ContourTracker tracker(View::kAlongZ);
  add_polyline(tracker, {{0, 0, 0}, {100, 0, 0}, {100, 0.5, 0}, {0, 0.5, 0}});
  tracker.follow(0, {50, 0, 0});
  EXPECT_NEAR(tracker.nearest({50, 0.45, 0}).distance, 0.45, 1e-12);
  for (double x = 50; x < 100; x += 0.05) {
    tracker.follow(0, {x, 0, 0});
  }
  tracker.follow(1, {100, 0.3, 0});
  for (double x = 100; x > 50; x -= 0.05) {
    tracker.follow(2, {x, 0.5, 0});
  }
  EXPECT_NEAR(tracker.nearest({50, 0.1, 0}).distance, 0.4, 1e-12);
}

TEST(ContourTracker, CutCornerIsItsDistanceFromTheLegs) {
  ContourTracker tracker(View::kAlongZ);
  add_polyline(tracker, {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}});
  tracker.follow(1, {10, 0.2, 0});
  EXPECT_NEAR(tracker.nearest({9.9, 0.06, 0}).distance, 0.06, 1e-12);
  EXPECT_NEAR(tracker.nearest({10.03, -0.04, 0}).distance, 0.05, 1e-12);
}

TEST(ContourTracker, SkippingFindsWhatLookingAtEveryBlockFinds) {
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 0.02);
  std::vector<Vec3> points{Vec3::Zero()};
  for (int i = 0; i < 3000; ++i) {
    points.push_back(points.back() + Vec3(0.01 * std::cos(i * 0.003) + noise(random) * 0.3,
                                          0.01 * std::sin(i * 0.003) + noise(random) * 0.3, 0.0));
  }
  ContourTracker tracker(View::kSpace, 2.0);
  add_polyline(tracker, points);
  std::vector<double> s{0.0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    s.push_back(s.back() + (points[i] - points[i - 1]).norm());
  }
  for (std::size_t k = 1; k + 1 < points.size(); k += 7) {
    tracker.follow(static_cast<std::int64_t>(k), points[k]);
    const Vec3 p = points[k] + Vec3(noise(random), noise(random), noise(random));
    // between these two the window's ends, which cut blocks in two
    double narrow = 1e300;
    double wide = 1e300;
    const double width = 2.0 + 4.0 * (p - points[k]).norm();
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double d = nearest(line(points[i - 1], points[i]), p, View::kSpace).distance;
      wide = s[i] > s[k] - width - 0.2 && s[i - 1] < s[k] + width + 0.2 ? std::min(wide, d) : wide;
      narrow =
          s[i - 1] > s[k] - width + 0.2 && s[i] < s[k] + width - 0.2 ? std::min(narrow, d) : narrow;
    }
    const double found = tracker.nearest(p).distance;
    EXPECT_LE(found, narrow + 1e-12);
    EXPECT_GE(found, wide - 1e-12);
  }
}

TEST(ContourTracker, MemoryIsBoundedByTheReach) {
  ContourTracker tracker(View::kSpace);
  std::int64_t fed = 0;
  for (std::int64_t block = 0; block < 100000; ++block) {
    while (!tracker.is_ready(block)) {
      const auto x = static_cast<double>(fed++);
      tracker.add(line({x * 0.1, 0, 0}, {x * 0.1 + 0.1, 0, 0}));
    }
    const double x = static_cast<double>(block) * 0.1 + 0.05;
    tracker.follow(block, {x, 0, 0});
    const double lag = std::min(x, 0.3);
    ASSERT_NEAR(tracker.nearest({x - lag, 0.004, 0}).distance, 0.004, 1e-9);
    ASSERT_LT(tracker.stored(), 450U);
  }
}

TEST(ContourTracker, BlocksAtRestAndLiftsAreCountedAndPassed) {
  ContourTracker tracker(View::kAlongZ);
  gcode::Block dwell = line({10, 0, 0}, {10, 0, 0});
  dwell.motion = gcode::Motion::kDwell;
  tracker.add(line({0, 0, 0}, {10, 0, 0}));
  tracker.add(dwell);
  tracker.add(line({10, 0, 0}, {10, 0, 25}));
  tracker.add(line({10, 0, 25}, {10, 10, 25}));
  tracker.follow(0, {9.9, 0, 0});
  tracker.follow(1, {10, 0, 0});
  EXPECT_NEAR(tracker.nearest({9.8, 0.01, 0}).distance, 0.01, 1e-12);
  tracker.follow(2, {10, 0, 12});
  EXPECT_NEAR(tracker.nearest({9.99, 0.0, 0}).distance, 0.0, 1e-12);
  tracker.follow(3, {10, 0.3, 25});
  EXPECT_NEAR(tracker.nearest({10.01, 0.2, 0}).distance, 0.01, 1e-12);
}

TEST(ContourTracker, FollowsACommandThatLosesThePath) {
  ContourTracker tracker(View::kAlongZ);
  add_polyline(tracker, {{0, 0, 0}, {50, 0, 0}, {50, 50, 0}});
  tracker.follow(0, {1, 0, 0});
  tracker.follow(1, {50, 30, 0});  // samples left out between
  EXPECT_NEAR(tracker.nearest({50.02, 30, 0}).distance, 0.02, 1e-12);
}

TEST(ContourTracker, WithoutBlocksOrCommandThereIsNoError) {
  ContourTracker tracker(View::kSpace);
  tracker.follow(0, {1, 2, 3});
  EXPECT_EQ(tracker.nearest({1, 2, 3}).distance, 0.0);
  EXPECT_LT(tracker.ahead(0), 0.0);
  tracker.add(line({0, 0, 0}, {5, 0, 0}));
  tracker.add(line({5, 0, 0}, {9, 0, 0}));
  EXPECT_DOUBLE_EQ(tracker.ahead(0), 4.0);
  EXPECT_EQ(tracker.nearest({1, 2, 3}).distance, 0.0);
}

}  // namespace contour_tracker_test
}  // namespace twin::results
