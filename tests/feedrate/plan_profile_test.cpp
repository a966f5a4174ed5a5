#include <gtest/gtest.h>

#include "tests/support/blocks.hpp"
#include "tests/support/plan.hpp"
#include "tests/support/random_program.hpp"
#include "tests/support/s_curve.hpp"

// Acceleration profiles through the whole planner.
namespace twin::feedrate {
namespace plan_profile_test {

using test::kProfiles;
using test::PlanSettings;

PlanSettings with(AccelerationProfile profile) {
  PlanSettings settings;
  settings.model.acceleration_profile = profile;
  if (profile != AccelerationProfile::kTrapezoidal) {
    settings.path.planner = Planner::kPaper;
  }
  return settings;
}

/// Distances along the path at every period, rests of two periods at both ends.
std::vector<double> set_points(const test::Plan& plan, double period) {
  std::vector<double> points(2, 0.0);
  double begin = 0.0;
  double t = 0.0;  // into the phase
  for (const PlannedSegment& planned : plan.segments) {
    for (const Phase& phase : planned.phases) {
      for (; t < phase.duration; t += period) {
        points.push_back(begin + motion_at(phase, t).s);
      }
      t -= phase.duration;
    }
    begin += planned.segment.length;
  }
  points.insert(points.end(), 4, begin);
  return points;
}

/// The third difference of the set points over T^3 is a mean of the jerk, and so on.
void expect_limits_of_differences(const std::vector<double>& s, double period,
                                  const Limits& limits) {
  for (std::size_t i = 3; i < s.size(); ++i) {
    const double v = (s[i] - s[i - 1]) / period;
    const double a = (s[i] - 2.0 * s[i - 1] + s[i - 2]) / (period * period);
    const double j = (s[i] - 3.0 * s[i - 1] + 3.0 * s[i - 2] - s[i - 3]) / std::pow(period, 3.0);
    ASSERT_GE(v, -1e-6);
    ASSERT_LE(v, limits.feedrate * (1.0 + 1e-6));
    ASSERT_LE(std::abs(a), limits.acceleration * (1.0 + 1e-3));
    ASSERT_LE(std::abs(j), limits.jerk * (1.0 + 5e-3));
  }
}

TEST(PlanProfile, RandomProgramsKeepEveryLimitAndNeedNoFallback) {
  std::mt19937 random(1);
  for (int i = 0; i < 150; ++i) {
    const auto blocks = test::random_program(random, 25);
    for (const AccelerationProfile profile : kProfiles) {
      PlanSettings settings = with(profile);
      settings.look_ahead = i % 3 == 0 ? 2 : i % 3 == 1 ? 20 : 200;
      if (i % 2 == 0) {  // A is reached from a change of 20 mm/s on
        settings.limits.acceleration = 1000.0;
      }
      const auto planned = test::plan(blocks, settings);
      ASSERT_NO_FATAL_FAILURE(test::expect_whole(planned, settings.limits))
          << "program " << i << " profile " << static_cast<int>(profile);
      ASSERT_NO_FATAL_FAILURE(
          expect_limits_of_differences(set_points(planned, 1e-3), 1e-3, settings.limits))
          << "program " << i << " profile " << static_cast<int>(profile);
      EXPECT_EQ(planned.fallbacks, 0)
          << "program " << i << " profile " << static_cast<int>(profile);
    }
  }
}

double time_of_line(double length, double feedrate, AccelerationProfile profile) {
  return test::plan({test::line_block({0, 0, 0}, {length, 0, 0}, feedrate)}, with(profile)).time;
}

TEST(PlanProfile, RestToRestTakesTheClosedForm) {
  // A ramp from and to rest at V each covers V tau / 2, so the time is L / V + tau(V).
  constexpr double kA = 2450.0;
  constexpr double kJ = 50000.0;
  for (const double v : {20.0, 50.0, 119.0, 121.0, 200.0}) {
    const double trapezoidal = v < kA * kA / kJ ? 2.0 * std::sqrt(v / kJ) : v / kA + kA / kJ;
    EXPECT_NEAR(time_of_line(100.0, v, AccelerationProfile::kTrapezoidal), 100.0 / v + trapezoidal,
                1e-9);
    EXPECT_NEAR(time_of_line(100.0, v, AccelerationProfile::kSCurve),
                100.0 / v + std::max(2.0 * std::sqrt(v / kJ), 2.0 * v / kA), 1e-9);
    EXPECT_NEAR(time_of_line(100.0, v, AccelerationProfile::kFir), 100.0 / v + v / kA + kA / kJ,
                1e-9);
  }
}

TEST(PlanProfile, ShortMovesPeakWhereBothRampsFillThem) {
  // V tau(V) = L, each with its own tau; then the time is 2 tau(V).
  constexpr double kA = 2450.0;
  constexpr double kT = kA / 50000.0;
  const double fir_peak = 0.5 * (-kA * kT + std::sqrt(kA * kA * kT * kT + 4.0 * kA * 1.0));
  EXPECT_NEAR(time_of_line(1.0, 200.0, AccelerationProfile::kFir), 2.0 * (fir_peak / kA + kT),
              1e-6);
  const double s_curve_peak = std::sqrt(0.5 * kA * 20.0);  // 156 mm/s: A binds
  EXPECT_NEAR(time_of_line(20.0, 200.0, AccelerationProfile::kSCurve), 4.0 * s_curve_peak / kA,
              1e-6);
}

TEST(PlanProfile, At12000MillimetresPerMinuteTrapezoidalIsTheFastest) {
  // Straight, 200 mm/s is reached: the filtered ramp is the trapezoidal one, the S-curve longer.
  const auto straight = [](AccelerationProfile p) { return time_of_line(100.0, 200.0, p); };
  EXPECT_NEAR(straight(AccelerationProfile::kFir), straight(AccelerationProfile::kTrapezoidal),
              1e-9);
  EXPECT_GT(straight(AccelerationProfile::kSCurve),
            straight(AccelerationProfile::kTrapezoidal) + 0.03);
  // Short moves do not reach 120 mm/s: the S-curve is the trapezoidal ramp, the filtered longer.
  const auto brief = [](AccelerationProfile p) { return time_of_line(2.0, 200.0, p); };
  EXPECT_NEAR(brief(AccelerationProfile::kSCurve), brief(AccelerationProfile::kTrapezoidal), 1e-9);
  EXPECT_GT(brief(AccelerationProfile::kFir), brief(AccelerationProfile::kTrapezoidal) + 0.01);
}

TEST(PlanProfile, NoProfileIsFasterThanTrapezoidalOverRandomPrograms) {
  std::mt19937 random(2);
  std::array<double, 3> sum{};
  for (int i = 0; i < 60; ++i) {
    auto blocks = test::random_program(random, 25);
    for (gcode::Block& block : blocks) {
      block.feedrate = 200.0;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      PlanSettings settings = with(kProfiles[k]);
      settings.path.planner = Planner::kPaper;
      sum[k] += test::plan(blocks, settings).time;
    }
  }
  EXPECT_GT(sum[1], sum[0]);
  EXPECT_GT(sum[2], sum[0]);
  EXPECT_LT(std::max(sum[1], sum[2]), 1.5 * sum[0]);
}

}  // namespace plan_profile_test
}  // namespace twin::feedrate
