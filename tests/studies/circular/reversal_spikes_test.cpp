#include "studies/circular/reversal_spikes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "paths.hpp"

namespace twin::studies::circular {
namespace reversal_spikes_test {

using test::kTurn;
using test::path_of;
using units::deg_from_rad;
using units::rad_from_deg;

/// A bell of a height and standard deviation about an angle, whatever the turn.
double bell(double angle, double about, double height, double sigma) {
  const double off = std::remainder(angle - about, kTurn);
  return height * std::exp(-0.5 * off * off / (sigma * sigma));
}

constexpr double kSigma = rad_from_deg(1.0);
const double kHalfWidth_deg = 2.0 * std::sqrt(2.0 * std::log(2.0));  // of a bell of 1 deg

// Spikes 6 and 4 deg behind the reversals at 0 and 270 deg, one of them inwards, on an ellipse that
// is shifted.
TEST(ReversalSpikes, AreFoundWithAngleHeightAndWidthInBothSenses) {
  for (const Sense sense : kSenses) {
    const double s = sign_of(sense);
    const double first = rad_from_deg(s * 6.0);
    const double second = rad_from_deg(270.0 + s * 4.0);
    const auto radius = [&](double a) {
      return 19.99 + 0.004 * std::cos(2.0 * a) + 0.003 * std::sin(a) +
             bell(a, first, 0.008, kSigma) + bell(a, second, -0.005, kSigma);
    };
    const ReversalSpikes found =
        find_reversal_spikes(path_of(radius, sense), sense, spike_reach(2.5));
    EXPECT_NEAR(std::remainder(found.quadrant[0].angle - first, kTurn), 0.0, rad_from_deg(0.15));
    EXPECT_NEAR(found.quadrant[0].height, 0.008, 1e-5);
    EXPECT_NEAR(deg_from_rad(found.quadrant[0].width), kHalfWidth_deg, 0.01);
    EXPECT_NEAR(std::remainder(found.quadrant[3].angle - second, kTurn), 0.0, rad_from_deg(0.15));
    EXPECT_NEAR(found.quadrant[3].height, -0.005, 1e-5);
    EXPECT_NEAR(found.quadrant[1].height, 0.0, 1e-6);
    EXPECT_NEAR(found.quadrant[2].height, 0.0, 1e-6);
    EXPECT_NEAR(found.ripple, 0.0, 1e-6);
  }
}

TEST(ReversalSpikes, BeforeTheReversalDoNotCount) {
  const auto radius = [](double a) { return 20.0 + bell(a, rad_from_deg(84.0), 0.008, kSigma); };
  const ReversalSpikes found =
      find_reversal_spikes(path_of(radius), Sense::kCounterClockwise, rad_from_deg(20.0));
  EXPECT_LT(std::abs(found.quadrant[1].height), 1e-3);
  EXPECT_GT(found.ripple, 7e-3);
  const ReversalSpikes back = find_reversal_spikes(path_of(radius, Sense::kClockwise),
                                                   Sense::kClockwise, rad_from_deg(20.0));
  EXPECT_NEAR(back.quadrant[1].height, 0.008, 1e-5);  // clockwise it is behind it
}

TEST(ReversalSpikes, RippleIsThatAwayFromTheReversals) {
  const auto radius = [](double a) { return 20.0 + 0.002 * std::cos(60.0 * a); };
  const ReversalSpikes found =
      find_reversal_spikes(path_of(radius), Sense::kCounterClockwise, rad_from_deg(20.0));
  EXPECT_NEAR(found.ripple, 0.002, 1e-4);
}

TEST(ReversalSpikes, ReachGrowsWithTheAngularVelocityWithinBounds) {
  EXPECT_DOUBLE_EQ(deg_from_rad(spike_reach(0.1)), 15.0);
  EXPECT_DOUBLE_EQ(spike_reach(10.0), 0.5);
  EXPECT_DOUBLE_EQ(deg_from_rad(spike_reach(100.0)), 45.0);
}

}  // namespace reversal_spikes_test
}  // namespace twin::studies::circular
