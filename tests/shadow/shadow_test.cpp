#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/atomic_file.hpp"
#include "shadow/hum_tracker.hpp"
#include "shadow/live_shadow.hpp"
#include "shadow/report.hpp"
#include "shadow/whitener.hpp"
#include "shadow_runs.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::shadow {
namespace shadow_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Whitener, AnAutoregressionIsFoundAndItsNoiseIsWhite) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise;
  std::vector<double> values(20000, 0.0);
  for (std::size_t k = 2; k < values.size(); ++k) {
    values[k] = 1.2 * values[k - 1] - 0.5 * values[k - 2] + noise(random);
  }
  std::vector<double> covariance(3, 0.0);
  for (std::size_t k = 2; k < values.size(); ++k) {
    for (std::size_t j = 0; j < 3; ++j) {
      covariance[j] += values[k] * values[k - j];
    }
  }
  const auto a = autoregression(covariance);
  ASSERT_EQ(a.size(), 2U);
  EXPECT_NEAR(a[0], 1.2, 0.03);
  EXPECT_NEAR(a[1], -0.5, 0.03);
  Whitener whitener(a, false);
  double square = 0.0;
  double product = 0.0;
  double last = 0.0;
  SignalRow white;
  for (const double value : values) {
    SignalRow row;
    row.residual = value;
    row.signature[0] = 2.0 * value;
    if (whitener.step(row, white)) {
      EXPECT_NEAR(white.signature[0], 2.0 * white.residual, 1e-9);
      square += white.residual * white.residual;
      product += white.residual * last;
      last = white.residual;
    }
  }
  EXPECT_NEAR(square / 20000.0, 1.0, 0.05);
  EXPECT_NEAR(product / 20000.0, 0.0, 0.03);
}

/// P(chi^2 > h) of the threshold, times the tests in the time, is one.
TEST(Evidence, TheThresholdKeepsItsRateOfFalseAlarms) {
  const double h = threshold_of(1000.0, 0.05, 0);
  const double tests = 1000.0 * 3600.0 / 0.05 * 2.0 * kCauses * 8.0;
  EXPECT_NEAR(std::erfc(std::sqrt(0.5 * h)) * tests, 1.0, 1e-6);
  EXPECT_GT(threshold_of(1000.0, 0.05, 20), 3.0 * h);
  EXPECT_NEAR(threshold_of(1000.0, 0.05, 1000000), h, 0.1);
}

ChannelBaseline white_baseline() {
  ChannelBaseline baseline;
  baseline.variance = 4.0;
  baseline.excess.fill(1.0);
  baseline.limit.fill(100.0);
  return baseline;
}

TEST(Evidence, AChangeIsFoundWithItsSizeItsTimeAndItsDeviation) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 2.0);
  const ChannelBaseline baseline = white_baseline();
  const ChannelFilter filter(baseline, {});
  Evidence evidence(baseline);
  for (int k = 0; k < 4000; ++k) {
    SignalRow row;
    row.signature[0] = std::sin(0.01 * k);
    row.signature[1] = std::cos(0.3 * k);
    row.residual = noise(random) + (k >= 2000 ? 0.7 * row.signature[0] : 0.0);
    ChannelFilter::Output output;
    output.row = {row.residual / 4.0, 1.0 / 4.0, row.signature};
    evidence.add(output, filter, 1.0, {.time = 0.001 * k, .line = k, .moving = 0.001 * k});
  }
  const Hypothesis found = evidence.hypotheses()[0];
  EXPECT_NEAR(found.change, 0.7, 4.0 * found.deviation);
  EXPECT_NEAR(found.deviation, 2.0 / std::sqrt(1000.0), 0.01);
  EXPECT_NEAR(found.since.time, 2.0, 0.4);
  EXPECT_GT(found.statistic, 60.0);
  EXPECT_LT(evidence.hypotheses()[1].statistic, 25.0);
}

TEST(JumpFinder, LostCountsAreCountedOnceEachAndOnlyAgainstTheMotion) {
  JumpShapes shapes;
  shapes.count = 10.0;
  shapes.step = {1.0};
  for (std::size_t j = 0; j < 128; ++j) {
    shapes.step.push_back(1.0 - static_cast<double>(j + 1) / 129.0);
  }
  for (const double direction : {1.0, -1.0}) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, 3.0);
    JumpFinder finder(shapes, 9.0, 50);
    double lost = 0.0;
    for (int k = 0; k < 3000; ++k) {
      double residual = noise(random);
      for (const int jump : {500, 900, 2000}) {  // of one, one and two counts towards minus
        const int age = k - jump;
        if (age >= 0 && age < static_cast<int>(shapes.step.size())) {
          residual -= (jump == 2000 ? 20.0 : 10.0) * shapes.step[static_cast<std::size_t>(age)];
        }
      }
      const auto found = finder.step(residual, direction);
      lost += found.counts.gain > 0.0 ? found.counts.size : 0.0;
    }
    EXPECT_EQ(lost, direction > 0.0 ? 4.0 : 0.0);
  }
}

TEST(HumTracker, AHumOfUnknownPhaseIsTakenOffTheResidual) {
  const auto machine = table_machine();
  hal::mujoco::AxisParams params = machine.table.axis[hal::kX];
  HumTracker tracker(params, machine.period, machine.table.physics_step, 13);
  ASSERT_TRUE(tracker.is_wanted());
  DrivenAxis with(params, machine.period, machine.table.physics_step, ScrewModel::kRigid, {});
  DrivenAxis model = with;
  with.begin(0.0, 0.3);
  model.begin(0.0, 0.3);
  double low = 0.0;
  double high = 0.0;
  std::vector<double> hum(13);
  for (int k = 0; k < 3000; ++k) {
    for (int i = 0; i < 13; ++i) {
      hum[static_cast<std::size_t>(i)] =
          0.03 * std::sin(2.0 * std::numbers::pi * 60.0 * (k + i / 13.0) * machine.period + 2.2);
    }
    with.advance(0.0, hum);
    model.advance(0.0, tracker.next_period());
    const double residual = units::um_from_mm(with.position() - model.position());
    tracker.take(residual, true);
    low = k == 2500 ? residual : std::min(low, residual);
    high = k == 2500 ? residual : std::max(high, residual);
  }
  EXPECT_TRUE(tracker.is_found());
  EXPECT_LT(high - low, 1.0);  // 15 um without
}

/// What a few healthy runs have taught, once for all tests.
const Baseline& learnt() {
  static const Baseline baseline = [] {
    const auto machine = table_machine();
    std::vector<Track> tracks;
    for (const char* const program : {"dolphin", "oxalis"}) {
      tracks.push_back(record(machine, {.program = program, .seed = 11}));
    }
    return checked(learn(machine, tracks, false));
  }();
  return baseline;
}

Shadow watched(const RunPlan& plan, std::string* lines = nullptr) {
  const auto machine = table_machine();
  const Track track = record(machine, plan);
  Shadow shadow(machine, learnt(), false, 1000.0, track.recorded);
  for (const ShadowSample& sample : track.samples) {
    shadow.step(sample);
  }
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    if (lines != nullptr && shadow.axis(axis)->finding()) {
      *lines += to_line(*shadow.axis(axis)->finding(), axis) + "\n";
    }
  }
  return shadow;
}

TEST(Shadow, AHealthyRunIsSilent) {
  std::string lines;
  watched({.program = "dolphin", .feedrate_mm_per_min = 2500.0, .seed = 21}, &lines);
  EXPECT_EQ(lines, "");
}

struct Broken {
  const char* change;
  hal::Axis axis;
  Cause cause;
  double size;
};

class BrokenAxis : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenAxis, IsNamedWithWhatChangedByHowMuchAndSinceWhen) {
  const Broken& broken = GetParam();
  std::string lines;
  const Shadow shadow =
      watched({.program = "dolphin", .seed = 31, .changes = {broken.change}}, &lines);
  const AxisShadow& axis = *shadow.axis(broken.axis);
  ASSERT_TRUE(axis.finding()) << lines;
  EXPECT_EQ(axis.finding()->cause.cause, broken.cause) << lines;
  const auto last = axis.last_finding();
  EXPECT_EQ(last->cause.cause, broken.cause);
  EXPECT_NEAR(last->cause.change, broken.size, 0.25 * std::abs(broken.size)) << lines;
  EXPECT_NEAR(last->cause.since.time, 1.72, 0.5);
  EXPECT_GT(last->cause.since.line, 0);
  EXPECT_LT(axis.finding()->found.time, 1.72 + 3.0);
  EXPECT_FALSE(shadow.axis(broken.axis == hal::kX ? hal::kY : hal::kX)->finding()) << lines;
}

INSTANTIATE_TEST_SUITE_P(
    , BrokenAxis,
    ::testing::Values(Broken{"friction:x=1.3@2", hal::kX, Cause::kFriction, 0.3},
                      Broken{"vref_gain:y=0.95@2", hal::kY, Cause::kVrefGain, -0.05},
                      Broken{"encoder_slip:x=1@2", hal::kX, Cause::kEncoder, 1e-3}));

TEST(Shadow, APeriodThatFindsNothingAllocatesNothing) {
  const auto machine = table_machine();
  const Track track =
      record(machine, {.program = "circle", .feedrate_mm_per_min = 6000.0, .seed = 3});
  Shadow shadow(machine, learnt(), false, 1000.0, track.recorded);
  const std::int64_t before = test::allocations();
  for (const ShadowSample& sample : track.samples) {
    shadow.step(sample);
  }
  EXPECT_EQ(test::allocations(), before);
}

TEST(Learning, MotionThatIsTooShortIsRefused) {
  const auto machine = table_machine();
  Track track = record(machine, {.program = "circle", .feedrate_mm_per_min = 6000.0});
  track.samples.resize(700);
  const auto refused = learn(machine, {track}, false);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("are too few to learn from"));
}

TEST(Learning, TheFileIsReadBackAndRefusedForAnotherMachineOrPeriod) {
  const test::TempFolder folder;
  const auto file = folder / "learnt.json";
  const auto machine = table_machine();
  ASSERT_TRUE(write_baseline(file, learnt()));
  const auto read = read_baseline(file, machine);
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->axis[hal::kY][0].coefficients, learnt().axis[hal::kY][0].coefficients);
  EXPECT_EQ(read->axis[hal::kX][0].scatter, learnt().axis[hal::kX][0].scatter);
  auto other = machine;
  other.table.axis[hal::kX].friction.coulomb *= 1.01;
  EXPECT_THAT(to_string(read_baseline(file, other).error()), HasSubstr("of another machine"));
  other = machine;
  other.period = 0.002;
  EXPECT_THAT(to_string(read_baseline(file, other).error()), HasSubstr("with a period of 0.001 s"));
  ASSERT_TRUE(write_whole_file(file, "{\"format\": \"twin shadow baseline 2\"}"));
  EXPECT_THAT(to_string(read_baseline(file, machine).error()), HasSubstr("'machine' should be"));
  ASSERT_TRUE(write_whole_file(file, "friction"));
  EXPECT_THAT(to_string(read_baseline(file, machine).error()), HasSubstr("this is no JSON"));
}

TEST(Shadow, AModelThatNobodyIdentifiedIsRefused) {
  auto machine = table_machine();
  EXPECT_TRUE(check_identified(machine));
  machine.table.is_identified = false;
  EXPECT_THAT(to_string(check_identified(machine).error()), HasSubstr("table.identified is false"));
}

/// Rows of a trace for a live shadow.
struct LiveRows {
  TraceHeader header;
  std::vector<double> values;

  explicit LiveRows(const Track& track) {
    for (const char* const name : {"t_s", "line", "x_enc_mm", "x_drive_V", "x_table_mm", "y_enc_mm",
                                   "y_drive_V", "y_table_mm"}) {
      header.columns.push_back({name});
    }
    for (const ShadowSample& s : track.samples) {
      values.insert(values.end(), {s.time, static_cast<double>(s.line)});
      for (const AxisSample& axis : s.axis) {
        values.insert(values.end(), {axis.measured, axis.volts, axis.scale});
      }
    }
  }
};

TEST(LiveShadow, OneThatFallsBehindIsSwitchedOffAndTheRunGoesOn) {
  const auto machine = table_machine();
  const LiveRows rows(record(machine, {.program = "dolphin", .feedrate_mm_per_min = 3000.0}));
  std::vector<std::string> told;
  LiveOptions options;
  options.is_wall_clock = true;
  options.tell = [&told](const std::string& line) { told.push_back(line); };
  LiveShadow shadow(machine, learnt(), false, options);
  ASSERT_FALSE(shadow.begin(rows.header));
  ASSERT_FALSE(shadow.rows(rows.values));  // 9.6 s at once
  ASSERT_FALSE(shadow.commit());
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0], HasSubstr("switched off, the run goes on: it fell behind"));
  EXPECT_THAT(to_json(shadow.report()), HasSubstr("it fell behind"));
}

TEST(LiveShadow, TheReactionStopEndsTheRunAtTheSamePeriodEachTime) {
  auto machine = table_machine();
  machine.shadow.stops = true;
  const LiveRows rows(record(machine, {.program = "dolphin", .changes = {"vref_gain:x=0.95@2"}}));
  std::string first;
  for (int i = 0; i < 2; ++i) {
    LiveShadow shadow(machine, learnt(), false, {});
    ASSERT_FALSE(shadow.begin(rows.header));
    std::string why;
    for (std::size_t at = 0; at < rows.values.size() && why.empty(); at += 800) {
      const std::size_t many = std::min<std::size_t>(800, rows.values.size() - at);
      const auto error = shadow.rows({rows.values.data() + at, many});
      why = error ? fmt::format("{} {}", at, error->message) : "";
    }
    shadow.abandon();
    EXPECT_THAT(why, HasSubstr("the shadow ends the run: axis x: gain of V-REF"));
    first = first.empty() ? why : first;
    EXPECT_EQ(why, first);
  }
}

TEST(LiveShadow, NeedsItsColumns) {
  const auto machine = table_machine();
  LiveShadow shadow(machine, learnt(), false, {});
  const auto error = shadow.begin({.columns = {{"t_s"}, {"line"}}});
  ASSERT_TRUE(error);
  EXPECT_THAT(error->message, HasSubstr("needs the column x_enc_mm"));
}

TEST(History, ATrendIsToldOnceItIsSure) {
  const test::TempFolder folder;
  const auto file = folder / "history.csv";
  ShadowReport report;
  std::vector<std::string> trends;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (int run = 0; run < 8; ++run) {
    report.axis[hal::kX].estimates = {
        {ChannelKind::kPosition, Cause::kFriction, 0.03 * run + noise(random), 0.01},
        {ChannelKind::kPosition, Cause::kVrefGain, noise(random), 0.01}};
    trends = checked(add_to_history(file, "2026-11-28T07:10:00Z", "a, b.nc", report));
    EXPECT_TRUE(run > 2 || trends.empty());
  }
  ASSERT_EQ(trends.size(), 1U);
  EXPECT_THAT(trends[0], HasSubstr("trend, axis x, position: friction: +0.0"));
  ASSERT_TRUE(write_whole_file(file, "time,what\n"));
  const auto refused = add_to_history(file, "now", "p", report);
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("history.csv:1: this is no history"));
}

}  // namespace shadow_test
}  // namespace twin::shadow
