#include "nc_programs/generate/rounding.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "nc_programs/generate/linearise.hpp"

namespace twin::programs {
namespace rounding_test {

FairCurve segment(const Point2& a, const Point2& b) { return {{a, 0.5 * (a + b), b}, 1.0}; }

Point2 polar(double radius, double angle) {
  return radius * Point2(std::cos(angle), std::sin(angle));
}

/// Corner of two lines of 20 mm at the origin, turning left by `turn` [rad].
struct Corner {
  explicit Corner(double turn)
      : before(segment({-20, 0}, {0, 0})), after(segment({0, 0}, polar(20, turn))) {}
  FairCurve before, after;
};

TEST(Round, BetweenTwoLinesItIsMirrorSymmetric) {
  const Corner c(2.0);
  const Round r = round_corner(c.before, c.after, {1.05, 1.0});
  const double cut_before = c.before.at(r.leave).point.norm();
  const double cut_after = c.after.at(r.meet).point.norm();
  EXPECT_NEAR(cut_before, cut_after, 1e-9);
}

TEST(Round, EndsWhereAndHowTheCurvesAre) {
  for (const double turn : {-2.4, -1.0, 0.6, 1.5, 2.6}) {
    const Corner c(turn);
    const Round r = round_corner(c.before, c.after, {1.05, 1.0});
    const Frame in = c.before.at(r.leave);
    const Frame out = c.after.at(r.meet);
    EXPECT_NEAR((r.frames.front().point - in.point).norm(), 0.0, 1e-12) << turn;
    EXPECT_NEAR((r.frames.back().point - out.point).norm(), 0.0, 1e-9) << turn;
    EXPECT_NEAR((r.frames.back().tangent - out.tangent).norm(), 0.0, 1e-9) << turn;
    EXPECT_NEAR(r.frames.back().curvature, out.curvature, 1e-12) << turn;
  }
}

TEST(Round, CurvatureReachesThePeakAndNoMore) {
  const Corner c(2.2);
  double most = 0.0;
  for (const Frame& f : round_corner(c.before, c.after, {1.05, 1.0}).frames) {
    most = std::max(most, std::abs(f.curvature));
  }
  EXPECT_NEAR(most, 1.05, 1e-9);
}

TEST(Round, CurvatureIntegratesToTheTurnOfTheCorner) {
  const Corner c(1.7);
  const Round r = round_corner(c.before, c.after, {1.05, 1.0});
  double sum = 0.0;
  for (std::size_t i = 1; i < r.frames.size(); ++i) {
    sum += 0.5 * (r.frames[i].curvature + r.frames[i - 1].curvature);
  }
  EXPECT_NEAR(sum * r.length / static_cast<double>(r.frames.size() - 1), 1.7, 1e-5);
}

TEST(Round, CurvesTooShortForTheRoundAreRefused) {
  const FairCurve before = segment({-0.5, 0}, {0, 0});
  const FairCurve after = segment({0, 0}, polar(0.5, 2.5));
  EXPECT_THROW(round_corner(before, after, {1.05, 1.0}), std::runtime_error);
}

Outline rounded_rectangle() {
  const std::vector<Point2> p = {{0, 0}, {30, 0}, {30, 20}, {0, 20}};
  std::vector<FairCurve> sides;
  for (std::size_t i = 0; i < 4; ++i) {
    sides.push_back(segment(p[i], p[(i + 1) % 4]));
  }
  return {sides, {0.5, 1.0}};
}

TEST(Linearise, CountThatNoToleranceGivesIsRefused) {
  const Outline outline = rounded_rectangle();
  EXPECT_THROW(linearise(outline, {190, 0.1, 0.5}, 0.0), std::runtime_error);
  EXPECT_THROW(linearise(outline, {900, 0.1, 0.5}, 0.0), std::runtime_error);
}

TEST(Linearise, RoundedRectangleTakesTheAskedNumberWithoutALeftOver) {
  const Outline outline = rounded_rectangle();
  const Chords chords = linearise(outline, {320, 0.1, 0.5}, outline.at_curve(0, 0.5));
  ASSERT_EQ(chords.points.size(), 321U);
  EXPECT_EQ(chords.points.front(), chords.points.back());
  double shortest = 1e9;
  double longest = 0.0;
  for (std::size_t i = 1; i < chords.points.size(); ++i) {
    const double l = (chords.points[i] - chords.points[i - 1]).norm();
    shortest = std::min(shortest, l);
    longest = std::max(longest, l);
  }
  EXPECT_GT(shortest, 0.0999);
  EXPECT_NEAR(longest, 0.5, 1e-6);
  EXPECT_LT((chords.points[1] - chords.points[0]).norm(), 0.5 + 1e-6);
  EXPECT_GT((chords.points[320] - chords.points[319]).norm(), 0.5 - 1e-6);
}

}  // namespace rounding_test
}  // namespace twin::programs
