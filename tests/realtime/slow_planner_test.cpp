#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>
#include <thread>

#include "runtime/motion.hpp"
#include "runtime/planning_loop.hpp"
#include "tests/support/fake_machine.hpp"
#include "tests/support/planned.hpp"
#include "tests/support/trace_rows.hpp"

// On the wall clock the machine waits for nothing. A planner that falls behind makes it brake on
// the path and go on later; the set points of all periods, pauses included, are held against the
// limits.
namespace twin::runtime {
namespace slow_planner_test {

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

/// What other threads may know of a machine: its periods, and whether it moves.
class Progress {
 public:
  explicit Progress(test::FakeMachine& machine) {
    machine.on_write = [this, &machine](std::int64_t) {
      const auto& at = machine.references;
      const bool moves = at.size() > 1 && at.back() != at[at.size() - 2];
      moved_ = moved_ + (moves ? 1 : 0);
      at_rest_ = moves ? 0 : at_rest_ + 1;
      ++periods_;
    };
  }

  std::int64_t periods() const { return periods_; }

  /// Waits until the machine has moved since the last such wait and then come to rest.
  void wait_for_rest() {
    constexpr int kRest = 5;  // [periods]
    EXPECT_TRUE(becomes([&] { return moved_ > moved_before_ && at_rest_ >= kRest; }));
    moved_before_ = moved_;
  }

  /// Waits until a number of periods have begun. @returns false when told to give up
  bool wait_for_period(std::int64_t number, const std::stop_token& gives_up) const {
    EXPECT_TRUE(becomes([&] { return periods_ >= number || gives_up.stop_requested(); }));
    return periods_ >= number;
  }

 private:
  /// However busy the computer is: a minute.
  static bool becomes(const std::function<bool()>& is_so) {
    for (int i = 0; i < 60000; ++i) {
      if (is_so()) {
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

  std::atomic<std::int64_t> periods_{0};
  std::atomic<std::int64_t> moved_{0};
  std::atomic<std::int64_t> at_rest_{0};
  std::int64_t moved_before_ = 0;
};

/// Plans the circle, as slowly as is told, past a motion on the wall clock.
struct SlowRun {
  explicit SlowRun(int buffer)
      : segments(static_cast<std::size_t>(buffer), static_cast<std::size_t>(buffer) + 2) {
    machine_file.path.look_ahead = buffer;
  }

  MotionEnd run(const std::function<void(std::int64_t)>& before_segment, SampleQueue& to) {
    const std::jthread planning([&] {
      ProgramPlanner planner(test::blocks_of(circle_in_arcs()), machine_file,
                             ProgramPlanner::Replans::kOnRequest);
      PlanningLoop loop(planner, segments, link, machine_file.path.look_ahead);
      loop.before_segment = before_segment;
      EXPECT_TRUE(loop.run());
    });
    WallClockPace::Options options;
    options.realtime.max_late_periods = 1000000;  // however busy the computer is
    options.realtime.max_stall = 1000.0;
    MonotonicClock clock;
    WallClockPace pace(segments, clock, options);
    const MotionEnd end =
        run_motion(cycle, interpolator, segments, to, pace,
                   {.rest_before = 0.01, .limits = machine_file.limits, .feed = &feed}, stop)
            .end;
    segments.stop();
    return end;
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

  config::MachineFile machine_file;
  std::array<motion::Gains, hal::kServoAxes> gains{};
  SegmentQueue segments;
  SampleQueue samples{100000};
  motion::Interpolator interpolator{segments, 1e-3};
  ReplanLink link;
  OperatorPanel panel;
  FeedControl feed{interpolator,
                   segments,
                   link,
                   panel,
                   {.schedule = {},
                    .ramp = {machine_file.limits.acceleration, machine_file.limits.jerk},
                    .period = 1e-3,
                    .is_wall_clock = true,
                    .feedrate = machine_file.limits.feedrate}};
  test::FakeMachine machine;
  Progress progress{machine};
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
  test::expect_within_limits(s, 1e-3, run.machine_file.limits, 40.0);
}

TEST(SlowPlanner, MachineBrakesOnThePathGoesOnAndReachesTheEnd) {
  SlowRun run(8);
  // Ten arcs at a time, and no more until the machine has used them up.
  const MotionEnd end = run.run(
      [&](std::int64_t i) {
        if (i % 10 == 9) {
          run.progress.wait_for_rest();
        }
      },
      run.samples);
  EXPECT_EQ(end, MotionEnd::kDone);
  EXPECT_GE(run.pauses(), 1);
  expect_whole_circle(run);
}

TEST(SlowPlanner, APlannerThatIsAheadIsNotNoticed) {
  SlowRun run(200);
  EXPECT_EQ(run.run({}, run.samples), MotionEnd::kDone);
  EXPECT_EQ(run.pauses(), 0);
  expect_whole_circle(run);
}

TEST(SlowPlanner, StopWhileItWaitsEndsAtRest) {
  SlowRun run(20);
  const MotionEnd end = run.run(
      [&](std::int64_t i) {
        if (i == 30) {
          run.progress.wait_for_rest();
          run.stop = true;
        }
      },
      run.samples);
  EXPECT_EQ(end, MotionEnd::kInterrupted);
  const auto s = along_circle(run.machine.references);
  EXPECT_GT(s.back(), 5.0);
  EXPECT_LT(s.back(), std::numbers::pi * kRadius);
  test::expect_within_limits(s, 1e-3, run.machine_file.limits, 40.0);
}

TEST(SlowPlanner, SamplesThatNobodyTakesEndTheMotion) {
  SlowRun run(200);
  SampleQueue few{10};
  EXPECT_EQ(run.run({}, few), MotionEnd::kTripped);
}

TEST(SlowPlanner, OperatorsOverrideAndHoldAreFollowedWhileItMoves) {
  SlowRun run(40);
  std::jthread operating([&](const std::stop_token& ended) {
    std::mt19937 random(3);
    std::int64_t period = 0;
    for (int i = 0; i < 12; ++i) {
      period += static_cast<std::int64_t>(60 + random() % 120);
      if (!run.progress.wait_for_period(period, ended)) {
        break;
      }
      run.panel.set_override(20.0 + static_cast<double>(random() % 180));
      run.panel.hold(i % 4 == 2);
    }
    run.panel.hold(false);
  });
  EXPECT_EQ(run.run({}, run.samples), MotionEnd::kDone);
  operating.request_stop();
  for (const Vec3& p : run.machine.references) {
    ASSERT_NEAR(std::hypot(p.x() + kRadius, p.y()), kRadius, 1e-6);
  }
  const auto s = along_circle(run.machine.references);
  EXPECT_NEAR(s.back(), 2.0 * std::numbers::pi * kRadius, 1e-6);
  test::expect_within_limits(s, 1e-3, run.machine_file.limits, 80.0);
  EXPECT_GE(run.feed.records().size(), 3U);
}

}  // namespace slow_planner_test
}  // namespace twin::runtime
