#include "runtime/switch_place.hpp"

#include <gtest/gtest.h>

namespace twin::runtime {
namespace switch_place_test {

using feedrate::Phase;

constexpr double kTolerance = 1e-3;  // [mm/s^2]

/// Up with jerk J for 0.1 s, down with -J for 0.2 s, up again for 0.1 s: a = 0 at 0.2 s, and a hold
/// of 0.5 s at the end; in one segment.
std::deque<SegmentPhases> humps() {
  constexpr double kJ = 1000.0;
  std::vector<Phase> phases{{0.1, 0.0, 20.0, 0.0, kJ}};
  for (const auto& [duration, jerk] : {std::pair{0.2, -kJ}, {0.1, kJ}, {0.5, 0.0}}) {
    const feedrate::PathMotion m = motion_at(phases.back(), phases.back().duration);
    phases.push_back({duration, m.s, m.v, m.a, jerk});
  }
  const double length = motion_at(phases.back(), phases.back().duration).s;
  return {{7, length, phases}};
}

TEST(SwitchPlace, IsWhereTheAccelerationPassesNought) {
  const auto place = find_switch_place(humps(), {7, 0, 0.0, 0.0}, 0.05, kTolerance);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->segment, 7);
  EXPECT_EQ(place->phase, 1U);
  EXPECT_NEAR(place->time, 0.1, 1e-12);
  EXPECT_NEAR(place->after, 0.2, 1e-12);
  EXPECT_NEAR(place->v, 30.0, 1e-9);
  EXPECT_FALSE(place->is_at_end);
}

TEST(SwitchPlace, InAHoldIsAtTheMargin) {
  const auto place = find_switch_place(humps(), {7, 1, 0.15, 0.0}, 0.4, kTolerance);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->phase, 3U);
  EXPECT_NEAR(place->time, 0.4 - 0.05 - 0.1, 1e-12);
  EXPECT_NEAR(place->after, 0.4, 1e-12);
  EXPECT_NEAR(place->v, 20.0, 1e-9);
}

TEST(SwitchPlace, IsNoneWhereThePlanEndsBeforeTheMargin) {
  EXPECT_FALSE(find_switch_place(humps(), {7, 0, 0.0, 0.0}, 0.95, kTolerance));
  EXPECT_FALSE(find_switch_place(humps(), {8, 0, 0.0, 0.0}, 0.0, kTolerance));
}

TEST(SwitchPlace, OfARestIsItsEnd) {
  std::deque<SegmentPhases> plan{{0, 0.0, {{0.3, 0.0, 0.0, 0.0, 0.0}}}};
  const auto place = find_switch_place(plan, {0, 0, 0.1, 0.0}, 0.02, kTolerance);
  ASSERT_TRUE(place);
  EXPECT_TRUE(place->is_at_end);
  EXPECT_EQ(place->time, 0.3);
  EXPECT_EQ(place->v, 0.0);
}

}  // namespace switch_place_test
}  // namespace twin::runtime
