#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "feedrate/tolerances.hpp"
#include "following.hpp"
#include "gcode/reader.hpp"
#include "tests/support/random_program.hpp"

// Stops under limits of single axes, which leave less acceleration and jerk to the motion along the
// path at some places than at others. The judge is differences of the set points: those of one
// coordinate never exceed the largest derivative.
namespace twin::motion {
namespace stop_test {

using test::PlanSource;

constexpr double kDoubt = 1.0005;  // rounding of positions in a third difference
constexpr double kSlack = 2e-3;    // the same, at limits near 0 [mm/s^k]

/// How many instants are tried: TWIN_STOPS, or some that take a second or two.
int instants() {
  const char* const wish = std::getenv("TWIN_STOPS");
  return wish != nullptr ? std::max(std::atoi(wish), 1) : 600;
}

/// The largest differences of the last four points, over the period, each over its limit.
struct Shares {
  double velocity = 0.0;
  double acceleration = 0.0;
  double jerk = 0.0;

  void see(const std::vector<Vec3>& p, const Limits& limits, double period) {
    const std::size_t n = p.size();
    const auto share = [](double value, double limit) {
      return limit > 0.0 ? std::max(std::abs(value) - kSlack, 0.0) / limit : 0.0;
    };
    for (int axis = 0; axis < 3 && n >= 4; ++axis) {
      const auto at = [&](std::size_t back) { return p[n - 1 - back][axis]; };
      const double d1 = (at(0) - at(1)) / period;
      const double d2 = (at(0) - 2.0 * at(1) + at(2)) / (period * period);
      const double d3 = (at(0) - 3.0 * at(1) + 3.0 * at(2) - at(3)) / (period * period * period);
      velocity = std::max(velocity, share(d1, limits.axis_feedrate[axis]));
      acceleration = std::max(acceleration, share(d2, limits.axis_acceleration[axis]));
      jerk = std::max(jerk, share(d3, limits.axis_jerk[axis]));
    }
  }
  double largest() const { return std::max({velocity, acceleration, jerk}); }
};

/// No stop within the limits of the places that it passes is shorter than this one.
feedrate::Brake shortest(const test::Plan& plan, const PlanPlace& place, double v, double a,
                         double reach, const Limits& limits) {
  feedrate::RampLimits most{0.0, 0.0};
  double passed = -place.s;
  for (auto i = static_cast<std::size_t>(place.segment);
       i < plan.segments.size() && passed <= reach; ++i) {
    for (const feedrate::LimitZone& zone : plan.segments[i].limits) {
      if (passed + zone.end >= 0.0 && passed + zone.begin <= reach) {
        most.acceleration =
            std::max(most.acceleration, std::min(zone.deceleration, limits.acceleration));
        most.jerk = std::max(most.jerk, std::min(zone.jerk, limits.jerk));
      }
    }
    passed += plan.segments[i].segment.length;
  }
  return feedrate::make_brake({0.0, v, a}, most);
}

/// What stops cost beside the shortest ones.
struct Costs {
  std::vector<double> time, distance;
  int plans = 0;
  int broken_plans = 0;

  std::string text() {
    const auto quantiles = [](std::vector<double>& ratios) {
      std::sort(ratios.begin(), ratios.end());
      const auto at = [&](double q) {
        return ratios[static_cast<std::size_t>(q * static_cast<double>(ratios.size() - 1))];
      };
      return fmt::format("p50 {:.3f}, p95 {:.3f}, max {:.3f}", at(0.5), at(0.95), at(1.0));
    };
    return time.empty() ? std::string()
                        : "time " + quantiles(time) + "; distance " + quantiles(distance);
  }
};

/// The plan of blocks by the certified planner, on its own path.
test::Plan plan_of(const std::vector<gcode::Block>& blocks, const test::PlanSettings& settings) {
  std::vector<path::Segment> segments;
  const auto builder =
      feedrate::make_planner(settings.limits, settings.model, settings.path, settings.period)
          ->make_builder([&](path::Segment&& segment) { segments.push_back(std::move(segment)); });
  for (const gcode::Block& block : blocks) {
    builder->push(block);
  }
  builder->finish();
  return test::plan(segments, settings);
}

/// Stops after `steps` set points and judges the way to rest.
void expect_stop(const test::Plan& plan, const test::PlanSettings& settings, std::size_t steps,
                 Costs& costs) {
  const double period = settings.period;
  PlanSource source(plan);
  Interpolator interpolator(source, period);
  std::vector<Vec3> points;
  SetPoint point;
  for (std::size_t i = 0; i <= steps; ++i) {
    ASSERT_EQ(interpolator.step(point), Status::kMoving);
    points.push_back(point.position);
  }
  const PlanPlace place = interpolator.place();
  const feedrate::PlannedSegment& segment = plan.segments[static_cast<std::size_t>(place.segment)];
  const auto from = feedrate::motion_at(segment.phases[place.phase], place.time);
  const double start = interpolator.distance();
  interpolator.brake({settings.limits.acceleration, settings.limits.jerk});
  Shares shares;
  std::size_t count = 0;
  double low = point.feedrate + 0.5 * from.a * from.a / settings.limits.jerk;
  Status status = interpolator.step(point);
  for (; status == Status::kMoving; status = interpolator.step(point)) {
    points.push_back(point.position);
    shares.see(points, settings.limits, period);
    ASSERT_LT(++count, 200000U);
    low = std::min(low, point.feedrate);
  }
  ASSERT_EQ(status, Status::kAtRest);
  ASSERT_EQ(point.feedrate, 0.0);
  for (int i = 0; i < 3; ++i) {
    points.push_back(point.position);
    shares.see(points, settings.limits, period);
  }
  const double distance = interpolator.distance() - start;
  ASSERT_LE(shares.velocity, kDoubt);
  ASSERT_LE(shares.acceleration, kDoubt);
  ASSERT_LE(shares.jerk, kDoubt);
  const feedrate::Brake bound = shortest(plan, place, from.v, from.a, distance, settings.limits);
  if (bound.distance > 1e-3) {
    costs.distance.push_back(distance / bound.distance);
    costs.time.push_back(static_cast<double>(count) * period / (bound.duration + period));
  }
}

void report(Costs& costs) {
  if (std::getenv("TWIN_STOPS") != nullptr) {
    fmt::print("{} stops, over the shortest possible: {}\n", costs.time.size(), costs.text());
  }
}

test::PlanSettings random_settings(std::mt19937& random) {
  const auto any = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<>(0.0, 1.0)(random));
  };
  test::PlanSettings settings;
  settings.period = random() % 2 == 0 ? 1e-3 : 5e-4;
  for (int axis = 0; axis < 2; ++axis) {
    settings.limits.axis_feedrate[axis] = random() % 4 == 0 ? any(10.0, 200.0) : 0.0;
    settings.limits.axis_acceleration[axis] = random() % 2 == 0 ? any(300.0, 3000.0) : 0.0;
    settings.limits.axis_jerk[axis] = random() % 3 > 0 ? any(8000.0, 60000.0) : 0.0;
  }
  return settings;
}

void expect_stops(const test::Plan& plan, const test::PlanSettings& settings, int tries,
                  std::mt19937& random, Costs& costs) {
  ++costs.plans;
  std::vector<Vec3> points;
  Shares shares;
  for (const SetPoint& point : test::follow(plan, settings.period)) {
    points.push_back(point.position);
    shares.see(points, settings.limits, settings.period);
  }
  const std::size_t count = points.size();
  if (shares.largest() > kDoubt) {
    ++costs.broken_plans;  // another test's matter
    return;
  }
  for (int k = 0; k < tries && count > 2; ++k) {
    const std::size_t steps = random() % (count - 1);
    ASSERT_NO_FATAL_FAILURE(expect_stop(plan, settings, steps, costs))
        << "step " << steps << " of " << count << ", axis acceleration "
        << settings.limits.axis_acceleration.transpose() << ", jerk "
        << settings.limits.axis_jerk.transpose() << ", period " << settings.period;
  }
}

// A part of a stop had lost all of the feedrate, and had 0.16 mm/s^2 of deceleration left by rounding
// within its stretch. The part behind it took no time and covered no distance, for ever.
TEST(StopPart, WithNothingLeftOfTheFeedrateTheStopIsOver) {
  feedrate::Stretch stretch;
  stretch.end = 0.0398;
  stretch.ramp = {926.878, 5461.94};
  for (const double v : {0.0, 1e-9}) {
    const auto part = feedrate::make_stop_part({0.0199, v, -0.16}, stretch);
    EXPECT_TRUE(part.rests) << v;
    EXPECT_EQ(part.brake.duration, 0.0) << v;
    EXPECT_EQ(feedrate::end_of(part.brake).s, 0.0199) << v;
  }
}

// Two stretches met where the plan was all but at rest. The place, 8e-11 mm before the end of the
// first, counted as on the second, whose jerk was too little to lose the deceleration before the
// feedrate: the slowdown came to the second's end, 0.08 mm further on, in no time.
TEST(StopPart, WithTooLittleJerkToLoseItsDecelerationItRestsAtOnce) {
  const feedrate::PathMotion from{0.07629612827564351, 6.462948739072161e-06, -0.3463151421877342};
  feedrate::Stretch stretch;
  stretch.end = 0.152592257;
  stretch.ramp = {1286.93312, 9198.135};
  const auto part = feedrate::make_stop_part(from, stretch);
  EXPECT_TRUE(part.rests);
  const feedrate::PathMotion end = feedrate::end_of(part.brake);
  EXPECT_NEAR(end.v, 0.0, 1e-12);
  EXPECT_NEAR(end.a, 0.0, 1e-9);
  EXPECT_NEAR(end.s, from.s, 1e-9);
}

/// A line that is gone along from rest to rest with one jerk up and down, in 4 t.
feedrate::PlannedSegment one_hump(std::int64_t index, double t, double jerk) {
  const double length = 2.0 * jerk * t * t * t;
  feedrate::PlannedSegment planned;
  planned.index = index;
  planned.segment.geometry = path::Line{};
  planned.segment.length = length;
  feedrate::PathMotion at{0.0, 0.0, 0.0};
  for (const double j : {jerk, -jerk, -jerk, jerk}) {
    planned.phases.push_back({t, at.s, at.v, at.a, j});
    at = feedrate::motion_at(planned.phases.back(), t);
  }
  planned.limits = {{0.0, length, 100.0}};
  return planned;
}

// What begins 8e-11 mm before the end of a stretch, all but at rest there, began on the next one.
TEST(Stop, JustBeforeARestWhereTheNextStretchHasLessJerkItRestsThere) {
  constexpr double kJerk = 9278.596;
  const double t = 0.25 * (0.064 + 3.7e-5);  // so the 64th period ends 37 us before the rest
  test::Plan plan;
  for (int i = 0; i < 2; ++i) {
    plan.segments.push_back(one_hump(i, t, i == 0 ? kJerk : 0.99 * kJerk));
  }
  const double first = plan.segments[0].segment.length;
  const double second = plan.segments[1].segment.length;
  plan.segments[0].stretches = {{.end = first, .ramp = {1298.0, kJerk}},
                                {.end = first + second, .ramp = {1286.0, 0.99 * kJerk}}};
  plan.segments[1].stretches = {{.end = second, .ramp = {1286.0, 0.99 * kJerk}}};
  PlanSource source(plan);
  Interpolator interpolator(source, 1e-3);
  SetPoint point;
  for (int i = 0; i <= 64; ++i) {
    ASSERT_EQ(interpolator.step(point), Status::kMoving);
  }
  ASSERT_LT(interpolator.distance(), first);
  ASSERT_GT(interpolator.distance(), first - feedrate::kPlaceRounding);
  interpolator.brake({2450.0, 50000.0});
  ASSERT_EQ(interpolator.step(point), Status::kMoving);
  EXPECT_NEAR(interpolator.distance(), first, 1e-9);
  EXPECT_TRUE(interpolator.is_at_rest());
}

TEST(StopUnderAxisLimits, KeepsThemFromRandomInstantsOfRandomPrograms) {
  std::mt19937 random(11);
  Costs costs;
  for (int i = 0; i < instants() / 2; i += 10) {
    const test::PlanSettings settings = random_settings(random);
    const auto plan = plan_of(test::random_program(random, 6), settings);
    ASSERT_NO_FATAL_FAILURE(expect_stops(plan, settings, 10, random, costs)) << "program " << i;
  }
  EXPECT_LE(50 * costs.broken_plans, costs.plans);
  report(costs);
}

TEST(StopUnderAxisLimits, KeepsThemFromRandomInstantsOfPrograms) {
  std::mt19937 random(12);
  Costs costs;
  for (const char* const name : {"square", "gear", "star", "oxalis", "mixed"}) {
    auto reader = gcode::Reader::open(std::string(TWIN_SOURCE_DIR "/nc_programs/") + name + ".nc",
                                      {.feedrate = 50.0});
    ASSERT_TRUE(reader);
    std::vector<gcode::Block> blocks;
    for (auto block = reader->next(); block && *block; block = reader->next()) {
      blocks.push_back(**block);
    }
    for (int i = 0; i < 3; ++i) {
      test::PlanSettings settings = random_settings(random);
      if (i == 0) {
        settings.limits.axis_jerk = {30000.0, 30000.0, 0.0};
      }
      const auto plan = plan_of(blocks, settings);
      ASSERT_NO_FATAL_FAILURE(expect_stops(plan, settings, instants() / 30, random, costs)) << name;
    }
  }
  EXPECT_EQ(costs.broken_plans, 0);
  report(costs);
}

}  // namespace stop_test
}  // namespace twin::motion
