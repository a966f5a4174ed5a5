#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>

#include "runtime/motion.hpp"
#include "tests/runtime/fake_machine.hpp"
#include "tests/runtime/planned.hpp"
#include "tests/runtime/trace_rows.hpp"

// On the wall clock the machine waits for nothing. A planner that falls behind makes it brake on
// the path and go on later; the set points of all periods, pauses included, are held against the
// limits.
namespace twin::runtime {
namespace {

constexpr double kRadius = 8.0;  // [mm]
constexpr int kArcs = 90;

/// Once round a circle about X0 Y0, in arcs of 4 degrees (0.56 mm).
std::string circle_in_arcs() {
  std::string text = "G17\n";
  for (int i = 1; i <= kArcs; ++i) {
    const double before = 2.0 * std::numbers::pi * (i - 1) / kArcs;
    const double after = 2.0 * std::numbers::pi * i / kArcs;
    text += fmt::format("G03 X{:.9f} Y{:.9f} I{:.9f} J{:.9f} F2400\n",
                        kRadius * (std::cos(after) - 1.0), kRadius * std::sin(after),
                        -kRadius * std::cos(before), -kRadius * std::sin(before));
  }
  return text;
}

/// Arc length along the circle that begins at X0 Y0 about X-8 Y0 [mm].
std::vector<double> along_circle(const std::vector<Vec3>& points) {
  std::vector<double> s;
  double turns = 0.0;
  double last = 0.0;
  for (const Vec3& p : points) {
    const double angle = std::atan2(p.y(), p.x() + kRadius);
    turns += angle - last < -std::numbers::pi ? 1.0 : 0.0;
    turns -= angle - last > std::numbers::pi ? 1.0 : 0.0;
    last = angle;
    s.push_back(kRadius * (angle + 2.0 * std::numbers::pi * turns));
  }
  return s;
}

/// Drives kArcs planned segments past a motion on the wall clock.
struct SlowRun {
  explicit SlowRun(std::size_t buffer) : segments(buffer) {}

  MotionEnd run(const std::function<void(int)>& before_push) {
    auto planned = test::plan_text(circle_in_arcs());
    std::jthread planner([&] {
      for (std::size_t i = 0; i < planned.size(); ++i) {
        before_push(static_cast<int>(i));
        if (!segments.push(std::move(planned[i]))) {
          return;
        }
      }
      segments.close();
    });
    const MotionEnd end = move(samples);
    segments.stop();
    return end;
  }

  /// Puts all segments into the buffer.
  void plan_ahead() {
    for (feedrate::PlannedSegment& segment : test::plan_text(circle_in_arcs())) {
      segments.push(std::move(segment));
    }
    segments.close();
  }

  MotionEnd move(SampleQueue& to) {
    Pace pace;
    pace.is_wall_clock = true;
    pace.settle_time = 0.01;
    pace.realtime.max_late_periods = 1000000;  // however busy the computer is
    pace.realtime.max_stall = 1000.0;
    return run_motion(cycle, interpolator, segments, to, limits, pace, stop).end;
  }

  /// How often it came to rest between start and end.
  int pauses() const {
    int count = 0;
    bool is_moving = false;
    for (std::size_t i = 1; i < machine.references.size(); ++i) {
      const bool moves = machine.references[i] != machine.references[i - 1];
      count += is_moving && !moves ? 1 : 0;
      is_moving = moves;
    }
    return count - (is_moving ? 0 : 1);
  }

  Limits limits;
  std::array<servo::Gains, hal::kServoAxes> gains{};
  SegmentQueue segments;
  SampleQueue samples{100000};
  interpolator::Interpolator interpolator{segments, 1e-3};
  test::FakeMachine machine;
  Cycle cycle{interpolator, &machine, gains, 1e-3};
  std::atomic<bool> stop{false};
};

/// The circle was followed to its end, on the path, within the limits.
void expect_whole_circle(const SlowRun& run) {
  for (const Vec3& p : run.machine.references) {
    ASSERT_NEAR(std::hypot(p.x() + kRadius, p.y()), kRadius, 1e-6);
  }
  const auto s = along_circle(run.machine.references);
  EXPECT_NEAR(s.back(), 2.0 * std::numbers::pi * kRadius, 1e-6);
  // Going on from rest, the plan's time runs at a growing rate, which adds a little.
  test::expect_within_limits(s, 1e-3, run.limits, 40.0, 0.1);
}

TEST(SlowPlanner, MachineBrakesOnThePathGoesOnAndReachesTheEnd) {
  SlowRun run(8);
  // 40 mm/s need an arc every 14 ms; these come every 25 ms, in fits and starts.
  const MotionEnd end = run.run([](int i) {
    if (i % 10 == 9) {
      std::this_thread::sleep_for(std::chrono::milliseconds(250));
    }
  });
  EXPECT_EQ(end, MotionEnd::kDone);
  EXPECT_GE(run.pauses(), 1);
  expect_whole_circle(run);
}

TEST(SlowPlanner, APlannerThatIsAheadIsNotNoticed) {
  SlowRun run(200);
  run.plan_ahead();
  EXPECT_EQ(run.move(run.samples), MotionEnd::kDone);
  EXPECT_EQ(run.pauses(), 0);
  expect_whole_circle(run);
}

TEST(SlowPlanner, StopWhileItWaitsEndsAtRest) {
  SlowRun run(20);
  const MotionEnd end = run.run([&](int i) {
    if (i == 30) {
      std::this_thread::sleep_for(std::chrono::milliseconds(700));
      run.stop = true;
    }
  });
  EXPECT_EQ(end, MotionEnd::kInterrupted);
  const auto s = along_circle(run.machine.references);
  EXPECT_GT(s.back(), 5.0);
  EXPECT_LT(s.back(), 31.0 * 2.0 * std::numbers::pi * kRadius / kArcs);
  test::expect_within_limits(s, 1e-3, run.limits, 40.0, 0.1);
}

TEST(SlowPlanner, SamplesThatNobodyTakesEndTheMotion) {
  SlowRun run(200);
  SampleQueue few{10};
  run.plan_ahead();
  EXPECT_EQ(run.move(few), MotionEnd::kTripped);
}

}  // namespace
}  // namespace twin::runtime
