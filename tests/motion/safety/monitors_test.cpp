#include "motion/safety/monitors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

// Each monitor on sequences made by hand: it trips in the right period, and not at its limit.
namespace twin::motion {
namespace monitors_test {

using ::testing::HasSubstr;

constexpr AxisFacts kAxis{0.001, 0.001, 100.0, 200.0};
constexpr int kNever = -1;

/// Index of the first view in which a monitor finds something.
template <Monitor M>
int first_trip(M monitor, int periods, const std::function<AxisView(int)>& view) {
  for (int k = 0; k < periods; ++k) {
    if (monitor.check(view(k))) {
      return k;
    }
  }
  return kNever;
}

AxisView at(double command, double measured) {
  AxisView view;
  view.command = command;
  view.measured = measured;
  view.counts = std::llround(measured / kAxis.mm_per_count);
  return view;
}

TEST(TrackingError, MayStayAtItsLimitForEverAndAboveItForTheFilterTime) {
  SafetySettings settings;
  settings.tracking_error = 0.5;
  settings.tracking_error_per_feedrate = 0.0;
  settings.tracking_filter_time = 0.0095;
  const TrackingError monitor(kAxis, settings);
  EXPECT_EQ(first_trip(monitor, 1000, [](int) { return at(0.5, 0.0); }), kNever);
  EXPECT_EQ(first_trip(monitor, 1000, [](int) { return at(0.0, 0.501); }), 9);
  // Nine periods above and one below it, again and again.
  EXPECT_EQ(first_trip(monitor, 1000, [](int k) { return at(k % 10 < 9 ? 0.6 : 0.1, 0.0); }),
            kNever);
}

TEST(TrackingError, IsAllowedToGrowWithTheFeedrate) {
  SafetySettings settings;
  settings.tracking_error = 0.5;
  settings.tracking_error_per_feedrate = 0.01;
  const TrackingError monitor(kAxis, settings);
  const auto moving = [](double error) {
    AxisView view = at(error, 0.0);
    view.feedrate = 100.0;
    return view;
  };
  EXPECT_EQ(first_trip(monitor, 100, [&](int) { return moving(1.499); }), kNever);
  EXPECT_NE(first_trip(monitor, 100, [&](int) { return moving(1.501); }), kNever);
}

TEST(TrackingError, OfTwiceItsLimitOrNoNumberTripsAtOnce) {
  const TrackingError monitor(kAxis, SafetySettings{});
  const double limit = SafetySettings{}.tracking_error;
  EXPECT_EQ(first_trip(monitor, 9, [&](int k) { return at(k < 3 ? 0.0 : 2.01 * limit, 0.0); }), 3);
  EXPECT_EQ(first_trip(monitor, 9, [](int) { return at(std::nan(""), 0.0); }), 0);
}

TEST(Runaway, AxisThatGoesAgainstItsCommandTrips) {
  SafetySettings settings;
  settings.runaway = 0.1;
  // Pushed at 100 mm/s one way, it goes 0.03 mm a period the other way.
  const auto view = [](double sign) {
    return [sign](int k) {
      AxisView v = at(0.0, -sign * 0.03 * k);
      v.volts = sign * 1.0;
      return v;
    };
  };
  EXPECT_EQ(first_trip(Runaway(kAxis, settings), 50, view(1.0)), 4);  // 0.12 mm
  EXPECT_EQ(first_trip(Runaway(kAxis, settings), 50, view(-1.0)), 4);
  EXPECT_EQ(first_trip(Runaway(kAxis, settings), 4, view(1.0)), kNever);  // 0.09 mm
}

TEST(Runaway, AxisThatLagsOrStandsOrComesBackDoesNot) {
  const auto pushed = [](double command, double measured) {
    AxisView v = at(command, measured);
    v.volts = command > measured ? 1.0 : -1.0;
    return v;
  };
  const Runaway monitor(kAxis, SafetySettings{});
  EXPECT_EQ(first_trip(monitor, 99, [&](int k) { return pushed(5.0 + 0.2 * k, 0.1 * k); }), kNever);
  EXPECT_EQ(first_trip(monitor, 99, [&](int) { return pushed(5.0, 0.0); }), kNever);
  EXPECT_EQ(first_trip(monitor, 99, [&](int k) { return pushed(0.0, 5.0 - 0.05 * k); }), kNever);
}

TEST(FrozenEncoder, CommandMayMoveByTheLimitAndTwoCountsWithoutACount) {
  SafetySettings settings;
  settings.frozen_encoder = 0.3;
  const FrozenEncoder monitor(kAxis, settings);  // 0.302 mm
  EXPECT_EQ(first_trip(monitor, 100, [](int k) { return at(0.01 * k, 0.0); }), 31);
  EXPECT_EQ(first_trip(monitor, 31, [](int k) { return at(-0.01 * k, 0.0); }), kNever);
}

TEST(FrozenEncoder, CommandThatSwingsOrAnEncoderThatCountsIsFine) {
  const FrozenEncoder monitor(kAxis, SafetySettings{});
  EXPECT_EQ(first_trip(monitor, 9999, [](int k) { return at(0.1 * std::sin(0.1 * k), 0.0); }),
            kNever);
  EXPECT_EQ(first_trip(monitor, 9999, [](int k) { return at(0.2 * k, 0.001 * k); }), kNever);
}

TEST(CountStep, IsJudgedByTheLargestFeedrateAndTheTimeThatPassed) {
  SafetySettings settings;
  settings.count_step_ratio = 2.0;  // 400 mm/s: 0.4 mm a period, and two counts
  const auto step = [](double mm, double interval) {
    return [mm, interval](int k) {
      AxisView view = at(0.0, k < 5 ? 0.0 : mm);
      view.interval = interval;
      return view;
    };
  };
  const CountStep monitor(kAxis, settings);
  EXPECT_EQ(first_trip(monitor, 9, step(0.4019, 0.001)), kNever);
  EXPECT_EQ(first_trip(monitor, 9, step(0.4021, 0.001)), 5);
  EXPECT_EQ(first_trip(monitor, 9, step(-0.4021, 0.001)), 5);
  EXPECT_EQ(first_trip(monitor, 9, step(0.8, 0.002)), kNever);
  EXPECT_EQ(first_trip(monitor, 9, step(0.4019, 0.0001)),
            kNever);  // an early read after a late one
}

TEST(CountStep, FirstCountsAreNoStep) {
  const CountStep monitor(kAxis, SafetySettings{});
  EXPECT_EQ(first_trip(monitor, 9, [](int) { return at(0.0, 123.0); }), kNever);
}

TEST(Saturation, MayLastForItsTime) {
  SafetySettings settings;
  settings.saturation_time = 0.0505;
  const Saturation monitor(kAxis, settings);
  const auto saturated = [](bool is_saturated) {
    AxisView view;
    view.is_saturated = is_saturated;
    return view;
  };
  EXPECT_EQ(first_trip(monitor, 99, [&](int) { return saturated(true); }), 50);
  EXPECT_EQ(first_trip(monitor, 999, [&](int k) { return saturated(k % 51 != 0); }), kNever);
  EXPECT_EQ(reaction_to(Kind::kSaturation), Reaction::kControlled);
}

TEST(DriveState, AlarmTripsAtOnceAndReadyOnlyWhenItGoes) {
  AxisView alarm;
  alarm.alarm = true;
  EXPECT_EQ(first_trip(DriveAlarm(kAxis, {}), 3, [&](int) { return alarm; }), 0);
  const auto ready = [](int from, int to) {
    return [from, to](int k) {
      AxisView view;
      view.servo_ready = k >= from && k < to;
      return view;
    };
  };
  EXPECT_EQ(first_trip(ReadyLost(kAxis, {}), 50, ready(20, 99)), kNever);
  EXPECT_EQ(first_trip(ReadyLost(kAxis, {}), 50, ready(20, 30)), 30);
}

TEST(Overtravel, SwitchThatIsMetTripsInBothDirections) {
  const auto met = [](bool positive, int when) {
    return [positive, when](int k) {
      AxisView view;
      view.limit_positive = positive && k >= when;
      view.limit_negative = !positive && k >= when;
      return view;
    };
  };
  EXPECT_EQ(first_trip(Overtravel(kAxis, {}), 50, met(true, 10)), 10);
  EXPECT_EQ(first_trip(Overtravel(kAxis, {}), 50, met(false, 10)), 10);
}

TEST(Overtravel, AxisThatStandsOnASwitchMayBeDrivenOffButNotOn) {
  const auto standing = [](double velocity) {
    return [velocity](int k) {
      AxisView view;
      view.limit_positive = k < 40 || k == 43 || k > 180;  // it bounces once
      view.velocity = k < 10 ? 0.0 : velocity;
      return view;
    };
  };
  EXPECT_EQ(first_trip(Overtravel(kAxis, {}), 180, standing(-1.0)), kNever);
  EXPECT_EQ(first_trip(Overtravel(kAxis, {}), 199, standing(-1.0)), 181);
  EXPECT_EQ(first_trip(Overtravel(kAxis, {}), 80, standing(1.0)), 10);
}

TEST(Monitors, BeforeServoReadyOnlySwitchesAreWatched) {
  AxisMonitors monitors(kAxis, SafetySettings{});
  AxisView view = at(50.0, 0.0);
  view.servo_ready = false;
  for (int k = 0; k < 100; ++k) {
    ASSERT_FALSE(monitors.check(view));
  }
  view.alarm = true;
  EXPECT_EQ(monitors.check(view)->kind, Kind::kDriveAlarm);
}

TEST(Monitors, ReportTheAxisAndPreferWhatMustSwitchOff) {
  hal::MachineInfo info;
  info.mm_per_count.fill(0.001);
  info.mm_per_s_per_volt.fill(100.0);
  SafetySettings settings;
  settings.saturation_time = 0.0;
  Monitors monitors(info, 0.001, 200.0, settings);
  std::array<AxisView, 2> views;
  EXPECT_FALSE(monitors.check(views));
  views[0].is_saturated = true;
  EXPECT_EQ(monitors.check(views)->axis, 0U);
  views[1].alarm = true;
  const auto trip = monitors.check(views);
  EXPECT_EQ(trip->axis, 1U);
  EXPECT_EQ(trip->kind, Kind::kDriveAlarm);
  EXPECT_TRUE(is_immediate(*trip));
}

TEST(TripText, NamesAxisValueLimitTimeLineAndWhatToDo) {
  EXPECT_EQ(describe({Kind::kTrackingError, 1, 0.6123, 0.5, 1.5, 42}),
            "axis y: tracking error 0.612 mm, limit 0.500 mm, at t = 1.500 s, NC line 42; 0 V and "
            "servo off at once; does the axis move freely, do [servo] and [safety] fit?");
  EXPECT_THAT(describe({Kind::kStall, kNoAxis, 0.1202, 0.1, 1.5, 42}),
              HasSubstr("a period began 120.2 ms late, limit 100.0 ms, at t = 1.500 s"));
  EXPECT_THAT(describe({Kind::kNotReady, 0, 3.0, 3.0, 0.0, 0}),
              HasSubstr("axis x: no servo ready after 3000 ms, limit 3000 ms, before the first"));
}

}  // namespace monitors_test
}  // namespace twin::motion
