#include "feedrate/certified/corner_times.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "feedrate/planner.hpp"
#include "path/smooth_builder.hpp"
#include "tests/support/blocks.hpp"
#include "tests/support/plan.hpp"

namespace twin::feedrate {
namespace corner_times_test {

using test::plan;
using test::PlanSettings;

/// Legs of one length that turn by an angle, now to the left, now to the right.
std::vector<gcode::Block> zigzag(int legs, double length, double turn, double feedrate) {
  std::vector<gcode::Block> blocks;
  Vec3 at = Vec3::Zero();
  double heading = 0.4;
  for (int i = 0; i < legs; ++i) {
    const Vec3 to = at + length * Vec3(std::cos(heading), std::sin(heading), 0.0);
    blocks.push_back(test::line_block(at, to, feedrate));
    at = to;
    heading += i % 2 == 0 ? turn : -turn;
  }
  return blocks;
}

/// Time of the blocks as the planner plans them, every corner as it is judged [s].
double judged_time(const std::vector<gcode::Block>& blocks, const PlanSettings& settings) {
  std::vector<path::Segment> segments;
  const auto parts = make_planner(settings.limits, settings.model, settings.path, settings.period);
  const auto builder =
      parts->make_builder([&](path::Segment&& segment) { segments.push_back(std::move(segment)); });
  for (const gcode::Block& block : blocks) {
    builder->push(block);
  }
  builder->finish();
  return plan(segments, settings).time;
}

/// The same with a bump at every corner [s].
double rounded_time(const std::vector<gcode::Block>& blocks, const PlanSettings& settings) {
  std::vector<path::Segment> segments;
  path::SmoothBuilder builder(
      settings.path, settings.model, settings.limits,
      [&](path::Segment&& segment) { segments.push_back(std::move(segment)); });
  for (const gcode::Block& block : blocks) {
    builder.push(block);
  }
  builder.finish();
  return plan(segments, settings).time;
}

/// Time of a leg from rest to rest under the limits of single axes as well: an S-curve [s].
double stop_time(const gcode::Block& block, const Limits& limits) {
  const Vec3 way = block.end - block.start;
  double a = limits.acceleration;
  double j = limits.jerk;
  for (int i = 0; i < 3; ++i) {
    const double share = std::abs(way[i]) / way.norm();
    a = limits.axis_acceleration[i] > 0.0 && share > 0.0
            ? std::min(a, limits.axis_acceleration[i] / share)
            : a;
    j = limits.axis_jerk[i] > 0.0 && share > 0.0 ? std::min(j, limits.axis_jerk[i] / share) : j;
  }
  const auto ramp = [&](double v) {
    return v < a * a / j ? 2.0 * std::sqrt(v / j) : v / a + a / j;
  };
  double low = 0.0;
  double high = block.feedrate;
  for (int i = 0; i < 24; ++i) {
    const double v = 0.5 * (low + high);
    (v * ramp(v) <= way.norm() ? low : high) = v;
  }
  return 2.0 * ramp(low) + (way.norm() - low * ramp(low)) / low;
}

double stopping_time(const std::vector<gcode::Block>& blocks, const Limits& limits) {
  double time = 0.0;
  for (const gcode::Block& block : blocks) {
    time += stop_time(block, limits);
  }
  return time;
}

PlanSettings certified() {
  PlanSettings settings;
  settings.path.planner = Planner::kCertified;
  return settings;
}

// A chord tolerance of 0.1 um at a period of 4 ms lets a bump of some 10 um be passed at 2 mm/s alone.
TEST(CornerTimes, AFineChordToleranceDoesNotMakeABumpSlowerThanAStop) {
  PlanSettings settings = certified();
  settings.period = 4e-3;
  settings.path.chord_error = 1e-4;
  settings.limits.acceleration = 11000.0;
  settings.limits.jerk = 6.7e6;
  const auto blocks = zigzag(20, 1.0, 1.2, 180.0);
  EXPECT_GT(rounded_time(blocks, settings), 1.5 * stopping_time(blocks, settings.limits));
  EXPECT_LE(judged_time(blocks, settings), 1.001 * stopping_time(blocks, settings.limits));
}

// Legs of a nanometre's size that turn back: the bump has the jerk of the axes all along.
TEST(CornerTimes, LegsThatAreBumpsAllAlongAreNoSlowerThanStops) {
  PlanSettings settings = certified();
  settings.limits.axis_jerk = {300.0, 80.0, 360.0};
  const auto blocks = zigzag(20, 2e-3, 2.9, 26.0);
  EXPECT_GT(rounded_time(blocks, settings), 1.05 * stopping_time(blocks, settings.limits));
  EXPECT_LE(judged_time(blocks, settings), 1.001 * stopping_time(blocks, settings.limits));
}

TEST(CornerTimes, RandomZigzagsTakeNoLongerThanWithStopsOrWithBumpsAlone) {
  std::mt19937 random(1);
  const auto log_uniform = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<double>(0.0, 1.0)(random));
  };
  int sharp = 0;
  for (int i = 0; i < 24; ++i) {
    PlanSettings settings = certified();
    settings.period = std::array{1e-3, 2.5e-4}[random() % 2];
    settings.path.short_block_length = 1e-3;  // corners, no runs
    settings.path.chord_error = log_uniform(1e-4, 1.0);
    settings.model.corner_error = log_uniform(1e-4, 1.0);
    settings.limits.acceleration = log_uniform(20.0, 1e6);
    settings.limits.jerk = log_uniform(500.0, 1e9);
    for (int axis = 0; axis < 2 && i % 2 == 0; ++axis) {
      settings.limits.axis_acceleration[axis] =
          settings.limits.acceleration * log_uniform(0.1, 1.2);
      settings.limits.axis_jerk[axis] = settings.limits.jerk * log_uniform(0.1, 1.2);
    }
    const auto blocks =
        zigzag(9, log_uniform(2e-3, 10.0),
               std::uniform_real_distribution<double>(0.05, std::numbers::pi)(random),
               settings.limits.feedrate * log_uniform(0.02, 1.0));
    const double time = judged_time(blocks, settings);
    const double rounded = rounded_time(blocks, settings);
    EXPECT_LE(time, 1.02 * stopping_time(blocks, settings.limits)) << "case " << i;
    EXPECT_LE(time, 1.1 * rounded) << "case " << i;
    sharp += time < 0.99 * rounded ? 1 : 0;
  }
  EXPECT_GT(sharp, 1);
}

}  // namespace corner_times_test
}  // namespace twin::feedrate
