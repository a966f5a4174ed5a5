#include "shadow/count_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "shadow_runs.hpp"

namespace twin::shadow {
namespace count_filter_test {

/// A level that walks, read through counts of 10 um at a speed of some counts a period.
std::vector<double> rounded_level(std::size_t periods, double walk, std::vector<double>& level) {
  std::mt19937 random(13);
  std::normal_distribution<double> noise;
  std::vector<double> residuals;
  double l = 0.0;
  for (std::size_t k = 0; k < periods; ++k) {
    l += walk * noise(random);
    level.push_back(l);
    const double model = 33.37 * static_cast<double>(k);
    residuals.push_back(10.0 * (std::floor((model + l) / 10.0) + 0.5) - model);
  }
  return residuals;
}

TEST(CountFilter, SlopesHaveTheVarianceThatTheCurvaturesSayAndFarLessThanThatOfRounding) {
  std::vector<double> level;
  const auto residuals = rounded_level(20000, 0.02, level);
  CountFilter filter(10.0, {.walk = 0.02, .white = 0.001}, 0.0);
  double square = 0.0;
  double curvature = 0.0;
  double slope = 0.0;
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    SignalRow row;
    row.residual = residuals[k];
    row.signature[0] = std::sin(0.05 * static_cast<double>(k));
    if (const auto step = filter.step(row, 1.0, 0.0); step.row != nullptr) {
      const WhiteRow& white = step.row->white;
      slope += white.score * white.signature[0];
      square += white.score * white.score * white.signature[0] * white.signature[0];
      curvature += white.weight * white.signature[0] * white.signature[0];
    }
  }
  EXPECT_NEAR(square / curvature, 1.0, 0.2);
  EXPECT_LT(std::abs(slope), 4.0 * std::sqrt(curvature));
  // Against noise of 10 um / sqrt(12) the sine has 1 / 8.33 in two periods.
  EXPECT_GT(curvature, 5.0 * 0.5 * 20000.0 / 8.33);
}

/// Cancellation made the curvature larger than 1, and the variance of the level negative.
TEST(CountFilter, ResidualsFarFromWhatIsExpectedKeepItFinite) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> exponent(-6.0, 9.0);
  CountFilter filter(4.5, {.walk = 1e-3, .white = 1e-3}, 0.7);
  for (int k = 0; k < 100000; ++k) {
    SignalRow row;
    row.residual = std::pow(10.0, exponent(random)) * (k % 3 - 1);
    row.signature[0] = row.residual;
    const auto step = filter.step(row, 1.0, 0.0);
    ASSERT_TRUE(std::isfinite(step.log_likelihood)) << k;
    ASSERT_TRUE(step.row == nullptr || std::isfinite(step.row->white.score)) << k;
    ASSERT_TRUE(step.row == nullptr || std::isfinite(step.row->white.signature[0])) << k;
  }
}

TEST(CountFilter, ALostCountIsFoundOnceAndOnlyAgainstTheMotion) {
  std::vector<double> level;
  const auto residuals = rounded_level(3000, 0.02, level);
  for (const double direction : {1.0, -1.0}) {
    CountFilter filter(10.0, {.walk = 0.02, .white = 0.01}, 0.0);
    double lost = 0.0;
    for (std::size_t k = 0; k < residuals.size(); ++k) {
      SignalRow row;
      row.residual = residuals[k] - (k >= 900 ? 10.0 : 0.0) - (k >= 2000 ? 20.0 : 0.0);
      lost -= filter.step(row, direction, 0.0).jump;
    }
    EXPECT_EQ(lost, direction > 0.0 ? 3.0 : 0.0);
  }
}

/// Friction of y, whose counts are 11.5 um: rounding as noise needs up to 2.4 s for it.
TEST(CountedShadow, FrictionIsNamedWithinTwoSecondsWithItsSize) {
  auto machine = table_machine();
  machine.shadow.reads_counts = true;
  std::vector<Track> tracks;
  for (const char* const program : {"dolphin", "oxalis"}) {
    tracks.push_back(record(machine, {.program = program, .seed = 11}));
  }
  const Baseline learnt = checked(learn(machine, tracks, false));
  ASSERT_EQ(learnt.axis[hal::kY].front().kind, ChannelKind::kCounts);
  const Track track =
      record(machine, {.program = "dolphin", .seed = 31, .changes = {"friction:y=1.3@2"}});
  Shadow shadow(machine, learnt, false, 1000.0, track.recorded);
  for (const ShadowSample& sample : track.samples) {
    shadow.step(sample);
  }
  EXPECT_FALSE(shadow.axis(hal::kX)->finding());
  const auto found = shadow.axis(hal::kY)->finding();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->cause.cause, Cause::kFriction);
  EXPECT_LT(found->found.time, 1.72 + 2.3);
  EXPECT_NEAR(shadow.axis(hal::kY)->last_finding()->cause.change, 0.3, 0.06);
}

}  // namespace count_filter_test
}  // namespace twin::shadow
