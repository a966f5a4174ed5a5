#include "motion/correction/correction_follower.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/allocations.hpp"

namespace twin::motion {
namespace correction_follower_test {

constexpr double kPeriod = 0.001;

/// A straight way of 2,000 periods with a slow sine as offset.
Correction sine(double amplitude) {
  Correction correction;
  for (int k = 0; k < 2000; ++k) {
    correction.points.emplace_back(0.01 * k, 0.0, 0.0);
    correction.offsets.emplace_back(amplitude * std::cos(0.01 * k), amplitude * std::sin(0.01 * k));
  }
  return correction;
}

TEST(CorrectionFollower, ApproachesTheFirstOffsetAtRestAndThenGivesEachPeriodItsOwn) {
  const Correction correction = sine(0.02);
  CorrectionFollower follower(&correction, kPeriod);
  double last = 0.0;
  for (int i = 0; i < 300; ++i) {
    follower.rest();
    EXPECT_LE(std::abs(follower.offset().position.x() - last), 0.02 * 1.9 * kPeriod / 0.2);
    last = follower.offset().position.x();
  }
  EXPECT_DOUBLE_EQ(last, correction.offsets.front().x());
  for (std::size_t k = 0; k < correction.points.size(); ++k) {
    follower.follow(correction.points[k]);
    ASSERT_EQ(follower.offset().position.x(), correction.offsets[k].x());
    if (k > 0 && k + 1 < correction.points.size()) {
      ASSERT_NEAR(follower.offset().velocity.y(), 0.02 * 10.0 * std::cos(0.01 * double(k)), 1e-4);
      ASSERT_NEAR(follower.offset().acceleration.y(), -0.02 * 100.0 * std::sin(0.01 * double(k)),
                  1e-3);
    }
  }
  follower.wait();
  EXPECT_EQ(follower.offset().position.x(), correction.offsets.back().x());
  EXPECT_EQ(follower.left_at(), -1);
}

TEST(CorrectionFollower, FadesSmoothlyWhereTheMotionLeavesItsPlan) {
  const Correction correction = sine(0.02);
  CorrectionFollower follower(&correction, kPeriod);
  for (std::size_t k = 0; k < 1000; ++k) {
    follower.follow(correction.points[k]);
  }
  Vec3 before = correction.points[999];
  Vec2 last = follower.offset().position.head<2>();
  Vec2 last_step = last - correction.offsets[998];
  for (int i = 0; i < 250; ++i) {
    before.x() += 0.005;  // at half the feedrate
    follower.follow(before);
    const Vec2 now = follower.offset().position.head<2>();
    const Vec2 step = now - last;
    // 0.02 mm over 0.2 s: at most 5.8 x 0.02 / 0.2^2 = 2.9 mm/s^2 more than the sine's own 2.
    EXPECT_LE((step - last_step).norm() / (kPeriod * kPeriod), 6.5) << i;
    last = now;
    last_step = step;
  }
  EXPECT_EQ(follower.left_at(), 1000);
  EXPECT_EQ(last.norm(), 0.0);
  follower.follow(correction.points[1250]);  // back on the plan: it does not return
  EXPECT_EQ(follower.offset().position.norm(), 0.0);
}

TEST(CorrectionFollower, FadesInAHoldThatComesAtRest) {
  const Correction correction = sine(0.02);
  CorrectionFollower follower(&correction, kPeriod);
  follower.follow(correction.points[0]);
  for (int i = 0; i < 201; ++i) {
    follower.wait();
  }
  EXPECT_EQ(follower.offset().position.norm(), 0.0);
  EXPECT_EQ(follower.left_at(), 1);
}

TEST(CorrectionFollower, WithoutACorrectionAddsNothing) {
  CorrectionFollower follower(nullptr, kPeriod);
  follower.rest();
  follower.follow({1.0, 2.0, 3.0});
  follower.wait();
  EXPECT_FALSE(follower.has_correction());
  EXPECT_EQ(follower.offset().position.norm(), 0.0);
}

TEST(CorrectionFollower, AllocatesNothing) {
  const Correction correction = sine(0.02);
  CorrectionFollower follower(&correction, kPeriod);
  const std::int64_t before = test::allocations();
  for (int i = 0; i < 300; ++i) {
    follower.rest();
  }
  for (std::size_t k = 0; k < 1500; ++k) {
    follower.follow(correction.points[k]);
  }
  for (int i = 0; i < 300; ++i) {
    follower.wait();
  }
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace correction_follower_test
}  // namespace twin::motion
