#include <gtest/gtest.h>

#include <algorithm>

#include "path/short_block.hpp"
#include "tests/support/blocks.hpp"

namespace twin::path {
namespace run_tolerance_test {

using test::build;
using test::distance_to;
using test::is_curve;
using test::is_line;
using test::polyline;
using test::random_walk;

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
    const auto points =
        random_walk(random, 120, 0.01, 0.3 + 0.05 * (i % 5), 0.02 + 0.05 * (i % 16));
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

/// A walk of which every corner passes the bi-chord test.
std::vector<Vec3> walk_of_short_blocks(std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<Vec3> points{{0, 0, 0}, {0.2, 0, 0}};
  double heading = 0.0;
  while (points.size() < 60) {
    const double turned = heading + 1.5 * (2.0 * part(random) - 1.0) * std::pow(part(random), 4);
    const Vec3 next = points.back() + 0.01 * std::pow(30.0, part(random)) *
                                          Vec3(std::cos(turned), std::sin(turned), 0.0);
    if (bi_chord_error(points[points.size() - 2], points.back(), next) < 0.0099) {
      points.push_back(next);
      heading = turned;
    }
  }
  return points;
}

TEST(RunTolerance, LeavesLinesWhereTheBiChordTestPassesAndTheCurveDoesNot) {
  std::mt19937 random(13);
  PathSettings unchecked;
  unchecked.chord_error = 1e3;
  std::size_t broken = 0;
  for (int i = 0; i < 60; ++i) {
    const auto points = walk_of_short_blocks(random);
    const auto blocks = polyline(points, 1.0);
    const auto segments = build(blocks);
    const auto lines = std::count_if(segments.begin(), segments.end(), is_line);
    if (worst_deviation(build(blocks, unchecked), points) > 0.02) {
      EXPECT_GT(lines, 0);
      ++broken;
    }
    EXPECT_LE(worst_deviation(segments, points), 0.01);
  }
  EXPECT_GT(broken, 10U);
}

}  // namespace run_tolerance_test
}  // namespace twin::path
