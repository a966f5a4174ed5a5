#include "studies/commissioning/homing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace twin::studies::commissioning {
namespace homing_test {

/// An axis on paper: switch below -95 mm, an index at every multiple of 10 mm, 0.05 mm of braking.
class PaperAxis {
 public:
  explicit PaperAxis(double start) : position(start) {}

  Expected<HomingStop> move(const HomingMove& wanted) {
    moves.push_back(wanted);
    const double start = position;
    const double sense = wanted.distance < 0.0 ? -1.0 : 1.0;
    const double end = start + wanted.distance;
    std::optional<double> met = meeting(wanted, start, sense);
    if (met && (*met - end) * sense > 0.0) {
      met.reset();
    }
    position = met ? *met + sense * 0.05 : end;
    HomingStop stop{position - start, {}};
    if (met) {
      stop.met_at = *met - start;
    }
    return stop;
  }

  double position;
  bool has_index = true;
  std::vector<HomingMove> moves;

 private:
  static constexpr double kSwitch = -95.0;

  std::optional<double> meeting(const HomingMove& wanted, double start, double sense) const {
    switch (wanted.until) {
      case Until::kNothing:
        return {};
      case Until::kLimitReached:
        return sense < 0.0 ? std::optional(std::min(start, kSwitch)) : std::nullopt;
      case Until::kIndex:
        return has_index ? std::optional(sense * 10.0 *
                                         std::ceil(sense * std::max(start, kSwitch) / 10.0))
                         : std::nullopt;
    }
    return {};
  }
};

TEST(Homing, EndsAtZeroFromWhereverItBegins) {
  const config::HomeSettings settings{false, 10.0, 1.0, 90.0};
  for (const double start : {-99.0, -3.7, 0.0, 55.5, -105.0}) {
    PaperAxis axis(start);
    const auto homed = home_axis(hal::kX, settings, 220.0, 10.0,
                                 [&](const HomingMove& wanted) { return axis.move(wanted); });
    ASSERT_TRUE(homed) << homed.error().message;
    EXPECT_NEAR(axis.position, 0.0, 1e-12) << "from " << start;
  }
}

TEST(Homing, LeavesTheSwitchAndFindsTheIndexSlowly) {
  PaperAxis axis(20.0);
  ASSERT_TRUE(home_axis(hal::kX, {false, 10.0, 1.0, 90.0}, 220.0, 10.0,
                        [&](const HomingMove& wanted) { return axis.move(wanted); }));
  ASSERT_EQ(axis.moves.size(), 3U);
  EXPECT_LT(axis.moves[0].distance, 0.0);
  EXPECT_EQ(axis.moves[0].feedrate, 10.0);
  EXPECT_GT(axis.moves[1].distance, 0.0);
  EXPECT_EQ(axis.moves[1].feedrate, 1.0);
  EXPECT_EQ(axis.moves[1].until, Until::kIndex);
}

TEST(Homing, SaysWhatWasNotMet) {
  PaperAxis axis(20.0);
  axis.has_index = false;
  const auto homed = home_axis(hal::kY, {false, 10.0, 1.0, 90.0}, 220.0, 10.0,
                               [&](const HomingMove& wanted) { return axis.move(wanted); });
  ASSERT_FALSE(homed);
  EXPECT_THAT(homed.error().message, ::testing::HasSubstr("axis y: the index was not met within"));
}

TEST(Homing, SwitchThatIsTooFarIsNotSoughtForEver) {
  PaperAxis axis(200.0);
  const auto homed = home_axis(hal::kX, {false, 10.0, 1.0, 90.0}, 220.0, 10.0,
                               [&](const HomingMove& wanted) { return axis.move(wanted); });
  ASSERT_FALSE(homed);
  EXPECT_THAT(homed.error().message, ::testing::HasSubstr("the limit switch was not met"));
}

}  // namespace homing_test
}  // namespace twin::studies::commissioning
