#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "path/corner/corner_motion.hpp"
#include "tests/runtime/override_run.hpp"
#include "tests/support/blocks.hpp"

// Programs with passages of corners, from text to set points: whatever is asked for on the way, the set
// points keep jerk and acceleration as vectors and stay within the tolerance of the program.
namespace twin::runtime {
namespace corner_passage_test {

using Schedule = std::vector<OverrideChange>;

config::MachineFile machine() {
  config::MachineFile machine;
  machine.limits.jerk_of = JerkOf::kVector;
  return machine;
}

double any(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<>(low, high)(random);
}

/// Lines of some lengths at any angle. Short ones are as long as corners need at low feedrates.
std::vector<Vec3> any_polygon(std::mt19937& random, int count, double shortest, double longest) {
  std::vector<Vec3> points{Vec3::Zero()};
  double heading = 0.0;
  for (int i = 0; i < count; ++i) {
    const double length = shortest * std::pow(longest / shortest, any(random, 0.0, 1.0));
    heading += any(random, 0.15, 3.1) * (random() % 2 == 0 ? 1.0 : -1.0);
    const Vec3 way = length * Vec3(std::cos(heading), std::sin(heading), 0.0);
    const Vec3 next = points.back() + way;
    points.push_back(next.cwiseAbs().maxCoeff() < 150.0 ? next : points.back() - way);
  }
  return points;
}

std::string program_of(const std::vector<Vec3>& points, std::mt19937& random) {
  std::string text = "G01 F3000\n";
  for (std::size_t i = 1; i < points.size(); ++i) {
    text += fmt::format("X{:.5f} Y{:.5f}{}\n", points[i].x(), points[i].y(),
                        random() % 6 == 0 ? fmt::format(" F{}", 600 * (1 + random() % 8)) : "");
  }
  return text;
}

/// Fails unless the set points begin and end at rest, and keep the limits by their differences.
void expect_kept(const test::OverrideRun& run, const std::vector<Vec3>& polygon,
                 const config::MachineFile& machine) {
  ASSERT_EQ(run.end, MotionEnd::kDone);
  std::vector<Vec3> p(3, run.samples.front().command);
  for (const results::Sample& sample : run.samples) {
    p.push_back(sample.command);
  }
  p.insert(p.end(), 3, p.back());
  const double t = machine.period;
  for (std::size_t i = 3; i < p.size(); ++i) {
    const double at = t * static_cast<double>(i - 3);
    ASSERT_LE((p[i] - p[i - 1]).norm(), machine.limits.feedrate * t) << at;
    ASSERT_LE((p[i] - 2.0 * p[i - 1] + p[i - 2]).norm(),
              machine.limits.acceleration * t * t * (1.0 + 1e-6))
        << at;
    const Vec3 third = p[i] - 3.0 * p[i - 1] + 3.0 * p[i - 2] - p[i - 3];
    ASSERT_LE(third.norm(), machine.limits.jerk * t * t * t * (1.0 + 1e-4) + 1e-12) << at;
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (machine.limits.axis_jerk[k] > 0.0) {
        ASSERT_LE(std::abs(third[k]),
                  machine.limits.axis_jerk[k] * t * t * t * (1.0 + 1e-4) + 1e-12)
            << at;
      }
    }
  }
  ASSERT_LT((p.back() - polygon.back()).norm(), 1e-4);
  for (const Vec3& point : p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < polygon.size(); ++k) {
      nearest = std::min(nearest, test::distance_to(point, polygon[k - 1], polygon[k]));
    }
    ASSERT_LE(nearest, machine.planning.corner_error + 1e-5);
  }
}

/// Holds, each followed by some override.
Schedule any_schedule(std::mt19937& random, int changes) {
  Schedule schedule;
  double t = 0.0;
  for (int k = 0; k < changes; ++k) {
    t += any(random, 0.01, 0.35);
    schedule.push_back({t, k % 2 == 0 ? 0.0 : any(random, 20.0, 130.0)});
  }
  return schedule;
}

TEST(CornerPassage, SetPointsKeepVectorJerkOnRandomPolygons) {
  std::mt19937 random(1);
  for (int i = 0; i < 12; ++i) {
    const double shortest = i % 3 == 0 ? 1.0 : i % 3 == 1 ? 3.0 : 8.0;
    const auto points = any_polygon(random, 12, shortest, 4.0 * shortest);
    const auto run = test::run_with_overrides(program_of(points, random), machine(), {});
    ASSERT_NO_FATAL_FAILURE(expect_kept(run, points, machine())) << i;
  }
}

TEST(CornerPassage, HoldsOverridesAndNewStartsKeepVectorJerkAndPath) {
  std::mt19937 random(2);
  for (int i = 0; i < 24; ++i) {
    const double shortest = i % 3 == 0 ? 1.0 : i % 3 == 1 ? 3.0 : 8.0;
    const auto points = any_polygon(random, 10, shortest, 4.0 * shortest);
    Schedule schedule;
    double t = 0.0;
    for (int k = 0; k < 6; ++k) {
      t += any(random, 0.01, 0.35);
      schedule.push_back({t, k % 2 == 0 ? (random() % 3 == 0 ? 50.0 : 0.0)
                                        : (random() % 3 == 0 ? 140.0 : any(random, 20.0, 100.0))});
    }
    const auto run = test::run_with_overrides(program_of(points, random), machine(), schedule);
    ASSERT_NO_FATAL_FAILURE(expect_kept(run, points, machine())) << i;
  }
}

TEST(CornerPassage, HoldsAndOverridesKeepTheJerkOfEachAxis) {
  config::MachineFile of_axes = machine();
  of_axes.limits.jerk = 1e6;
  of_axes.limits.axis_jerk = {50000.0, 20000.0, 0.0};
  of_axes.limits.axis_acceleration = {2000.0, 1200.0, 0.0};
  std::mt19937 random(4);
  for (int i = 0; i < 16; ++i) {
    const double shortest = i % 2 == 0 ? 3.0 : 8.0;
    const auto points = any_polygon(random, 10, shortest, 4.0 * shortest);
    const Schedule schedule = any_schedule(random, i % 4 == 0 ? 0 : 6);
    const auto run = test::run_with_overrides(program_of(points, random), of_axes, schedule);
    ASSERT_NO_FATAL_FAILURE(expect_kept(run, points, of_axes)) << i;
  }
}

/// Largest |d2v/dt2| of the set points' speed over two periods at a time; at a turn within a period the
/// speed of a chord is less than that of the path, by at most the square of the turn.
double path_jerk_of(const test::OverrideRun& run, double period) {
  std::vector<double> v;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    v.push_back((run.samples[i].command - run.samples[i - 1].command).norm() / period);
  }
  double largest = 0.0;
  for (std::size_t i = 4; i < v.size(); ++i) {
    largest =
        std::max(largest, std::abs(v[i] - 2.0 * v[i - 2] + v[i - 4]) / (4.0 * period * period));
  }
  return largest;
}

TEST(CornerPassage, UnderTheJerkOfThePathHoldsAndOverridesKeepItAndThatOfEachAxis) {
  config::MachineFile of_path;
  of_path.limits.axis_jerk = {50000.0, 40000.0, 0.0};
  of_path.limits.axis_acceleration = {2000.0, 1500.0, 0.0};
  config::MachineFile judge = of_path;
  judge.limits.jerk = of_path.limits.axis_jerk.norm();
  std::mt19937 random(5);
  for (int i = 0; i < 16; ++i) {
    std::vector<Vec3> points{Vec3::Zero()};
    double heading = 0.0;
    for (int k = 0; k < 8; ++k) {
      points.push_back(points.back() +
                       any(random, 4.0, 16.0) * Vec3(std::cos(heading), std::sin(heading), 0.0));
      heading += any(random, 0.08, 0.6) * (random() % 2 == 0 ? 1.0 : -1.0);
    }
    const Schedule schedule = any_schedule(random, i % 4 == 0 ? 0 : 6);
    const auto run = test::run_with_overrides(program_of(points, random), of_path, schedule);
    ASSERT_NO_FATAL_FAILURE(expect_kept(run, points, judge)) << i;
    ASSERT_LE(path_jerk_of(run, of_path.period), 1.03 * of_path.limits.jerk) << i;
  }
}

// From any instant: two passages at the most are on the way to rest.
TEST(CornerPassage, AHoldFromAnyInstantRestsOnThePathAndGoesOn) {
  const std::vector<Vec3> points{{0, 0, 0}, {8, 0, 0}, {8, 6, 0}, {2, 5, 0}, {2, 1, 0}, {8, 0, 0}};
  std::mt19937 random(3);
  std::string text = "G01 F3000\n";
  for (std::size_t i = 1; i < points.size(); ++i) {
    text += fmt::format("X{} Y{}\n", points[i].x(), points[i].y());
  }
  for (int i = 0; i < 40; ++i) {
    const double at = 0.0173 * (i + 1);
    const auto run = test::run_with_overrides(text, machine(), {{at, 0.0}, {at + 0.6, 100.0}});
    ASSERT_NO_FATAL_FAILURE(expect_kept(run, points, machine())) << at;
    const auto rest = static_cast<std::size_t>((at + 0.55) / machine().period);
    ASSERT_GT(run.samples.size(), rest + 5);
    ASSERT_EQ(run.samples[rest].command, run.samples[rest + 5].command) << at;
  }
}

TEST(CornerPassage, HalfTheOverrideTakesTwiceTheTimeInAPassage) {
  const std::string text = "G01 F3000\nX10\nY10\n";
  const auto whole = test::run_with_overrides(text, machine(), {});
  const auto half = test::run_with_overrides(text, machine(), {{0.0, 50.0}});
  const std::vector<Vec3> points{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}};
  ASSERT_NO_FATAL_FAILURE(expect_kept(half, points, machine()));
  EXPECT_GT(half.samples.size(), 1.6 * static_cast<double>(whole.samples.size()));
  EXPECT_LT(half.samples.size(), 2.1 * static_cast<double>(whole.samples.size()));
}

}  // namespace corner_passage_test
}  // namespace twin::runtime
