#include <gtest/gtest.h>

#include <algorithm>

#include "tests/path/blocks.hpp"

namespace twin::path {
namespace {

using testing::build;
using testing::distance_to;
using testing::is_curve;
using testing::is_line;
using testing::polyline;
using testing::random_walk;

/// Largest distance of the curves from the chords of their own blocks, by dense sampling [mm].
double worst_deviation(const std::vector<Segment>& segments, const std::vector<Vec3>& points) {
  double worst = 0.0;
  for (const Segment& segment : segments) {
    if (!is_curve(segment)) {
      continue;
    }
    const auto& fitted = std::get<FittedCurve>(segment.geometry);
    const auto first = static_cast<std::size_t>(segment.marks.front().block);
    for (int i = 0; i <= 600; ++i) {
      const Vec3 p = fitted.curve.position(fitted.curve.u_max() * i / 600.0);
      double nearest = 1e9;
      for (std::size_t k = first; k < first + segment.marks.size(); ++k) {
        nearest = std::min(nearest, distance_to(p, points[k], points[k + 1]));
      }
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

TEST(RunTolerance, IsKeptOverTheWholeLengthOfEveryCurveOfARandomWalk) {
  std::mt19937 random(11);
  std::size_t curves = 0;
  for (int i = 0; i < 80; ++i) {
    const auto points = random_walk(random, 120, 0.01, 0.3 + 0.05 * (i % 5), 0.02 + 0.05 * (i % 16));
    const auto segments = build(polyline(points, i % 3 == 0 ? 45.0 : 3.0));
    EXPECT_LE(worst_deviation(segments, points), 0.01);
    curves += static_cast<std::size_t>(std::count_if(segments.begin(), segments.end(), is_curve));
  }
  EXPECT_GT(curves, 200U);
}

TEST(RunTolerance, OfG64HoldsInsteadOfTheMachines) {
  std::mt19937 random(12);
  for (const double tolerance : {0.0005, 0.003, 0.05}) {
    for (int i = 0; i < 15; ++i) {
      const auto points = random_walk(random, 100, 0.01, 0.3, 0.3);
      auto blocks = polyline(points, 3.0);
      for (gcode::Block& block : blocks) {
        block.tolerance = tolerance;
      }
      EXPECT_LE(worst_deviation(build(blocks), points), tolerance);
    }
  }
}

TEST(RunTolerance, IsKeptWhereLongAndShortChordsAlternate) {
  // A cubic with chord-length parameters swings out of a long chord beside short ones that turn.
  for (const double turn : {0.005, 0.02, 0.05, 0.1}) {
    std::vector<Vec3> points{Vec3::Zero()};
    double heading = 0.0;
    for (int i = 0; i < 60; ++i) {
      const double length = i % 3 == 0 ? 0.5 : 0.02;
      points.push_back(points.back() + length * Vec3(std::cos(heading), std::sin(heading), 0.0));
      heading += turn * (i % 2 == 0 ? 1.0 : -0.7);
    }
    EXPECT_LE(worst_deviation(build(polyline(points, 3.0)), points), 0.01);
  }
}

TEST(RunTolerance, IsKeptOnZigzags) {
  // So slow that every corner passes Eq. 1; the bi-chord test alone would let them through.
  for (const double turn : {0.2, 0.5, 0.9, 1.3, 1.5}) {
    for (const double length : {0.01, 0.03, 0.05, 0.1, 0.3}) {
      std::vector<Vec3> points{Vec3::Zero()};
      for (int i = 0; i < 60; ++i) {
        const double heading = i % 2 == 0 ? 0.5 * turn : -0.5 * turn;
        points.push_back(points.back() + length * Vec3(std::cos(heading), std::sin(heading), 0.0));
      }
      EXPECT_LE(worst_deviation(build(polyline(points, 1.0)), points), 0.01);
    }
  }
}

/// Straight chords of 1 mm, but for two short ones that step aside by 7 um.
std::vector<Vec3> step_aside() {
  std::vector<Vec3> points;
  for (int i = 0; i <= 8; ++i) {
    points.emplace_back(1.0 * i, 0.0, 0.0);
  }
  for (int i = 0; i <= 8; ++i) {
    points.emplace_back(8.02 + 1.0 * i, 0.007, 0.0);
  }
  return points;
}

TEST(RunTolerance, LeavesALineWhereACurveWouldLeaveIt) {
  PathSettings wide;
  wide.chord_error = 10.0;
  const auto points = step_aside();
  const auto blocks = polyline(points, 1.0);
  PathSettings settings;
  // The run is one for the bi-chord test, and a curve through all of it leaves the band.
  const auto unchecked = build(blocks, wide);
  ASSERT_TRUE(std::all_of(unchecked.begin(), unchecked.end(), is_curve));
  ASSERT_GT(worst_deviation(unchecked, points), settings.chord_error);
  const auto segments = build(blocks, settings);
  EXPECT_LE(worst_deviation(segments, points), settings.chord_error);
  EXPECT_TRUE(std::any_of(segments.begin(), segments.end(), is_line));
  EXPECT_TRUE(std::any_of(segments.begin(), segments.end(), is_curve));
}

}  // namespace
}  // namespace twin::path
