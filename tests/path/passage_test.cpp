#include "path/passage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace twin::path {
namespace passage_test {

/// Time lost on one side, by steps of time: a constant jerk from r V to V over h, then J up to the
/// place from which -J just ends at F.
double loss_by_steps(double dip, double h, double bump, double feedrate, double jerk,
                     double bump_jerk = 1e9) {
  constexpr double kStep = 1e-7;
  const double time = 3.0 * h / (bump * (1.0 + 2.0 * dip));
  const double inside = std::min(2.0 * bump * (1.0 - dip) / (time * time), bump_jerk);
  double v = dip * bump;
  double a = 0.0;
  double s = 0.0;
  double t = 0.0;
  while (v < feedrate * (1.0 - 1e-9)) {
    const bool is_leaving = v + 0.5 * a * a / jerk >= feedrate;
    const double j = s < h ? inside : is_leaving ? -jerk : jerk;
    a = std::max(a + j * kStep, 0.0);
    v += a * kStep;
    s += v * kStep;
    t += kStep;
    if (is_leaving && a == 0.0) {
      break;
    }
  }
  return t - s / feedrate;
}

TEST(Passage, LosesWhatAnIntegrationByStepsLoses) {
  for (const double h : {0.05, 0.1, 0.3}) {
    for (const double bump : {4.0, 10.0, 30.0}) {
      const Passage passage = best_passage({h, bump, 1e9}, 50.0, 50000.0);
      EXPECT_NEAR(passage.loss, loss_by_steps(passage.dip, h, bump, 50.0, 50000.0), 2e-5)
          << h << " " << bump;
    }
  }
}

TEST(Passage, WithADipIsNoSlowerThanWithout) {
  const Passage passage = best_passage({0.1146, 10.0, 1e9}, 50.0, 50000.0);
  EXPECT_LT(passage.dip, 1.0);
  EXPECT_LT(passage.loss, loss_by_steps(1.0, 0.1146, 10.0, 50.0, 50000.0) - 1e-3);
}

// With all of J in the bend a dip to 0.55 V was the best. The bend left a quarter of J: the feedrate
// came out of it at 0.7 V, and a corner took 0.03 s more than without a dip.
TEST(Passage, ItsDipIsNoLowerThanTheJerkThatTheBendLeavesMakesUpFor) {
  const double h = 0.0822;
  for (const double share : {0.05, 0.25, 0.5, 1.0}) {
    const Passage passage = best_passage({h, 3.12, share * 2093.8}, 7.6, 2093.8);
    EXPECT_NEAR(passage.loss, loss_by_steps(passage.dip, h, 3.12, 7.6, 2093.8, share * 2093.8),
                1e-4)
        << share;
    EXPECT_LE(passage.loss, loss_by_steps(1.0, h, 3.12, 7.6, 2093.8) + 1e-4) << share;
  }
  EXPECT_GT(best_passage({h, 3.12, 0.25 * 2093.8}, 7.6, 2093.8).dip, 0.9);
}

TEST(Passage, OfABumpThatAllowsTheFeedrateLosesNothing) {
  EXPECT_EQ(best_passage({0.1, 60.0, 1e9}, 50.0, 50000.0).loss, 0.0);
  EXPECT_EQ(best_passage({0.1, 60.0, 1e9}, 50.0, 50000.0).dip, 1.0);
}

TEST(Passage, AStopLosesHalfTheTimeOfItsRamp) {
  // The ramp of jerk alone from rest to F takes 2 sqrt(F / J), at half of F on average.
  EXPECT_DOUBLE_EQ(stop_loss(50.0, 50000.0), std::sqrt(50.0 / 50000.0));
}

TEST(Passage, WithinADistanceARiseFromRestReachesTheFeedrateOfItsRamp) {
  const double v = feedrate_within(0.5, 1000.0, 50000.0);
  EXPECT_NEAR(0.5 * v * 2.0 * std::sqrt(v / 50000.0), 0.5, 1e-12);
  EXPECT_EQ(feedrate_within(100.0, 50.0, 50000.0), 50.0);
}

}  // namespace passage_test
}  // namespace twin::path
