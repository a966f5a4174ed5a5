#include "runtime/feed_control.hpp"

#include <gtest/gtest.h>

#include "runtime/replan_link.hpp"
#include "runtime/segment_queue.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/planned.hpp"

namespace twin::runtime {
namespace feed_control_test {

constexpr double kPeriod = 1e-3;  // [s]

/// A line of 100 mm on the wall clock; this test is the planning thread.
class FeedControlTest : public ::testing::Test {
 protected:
  FeedControlTest() {
    for (feedrate::PlannedSegment& segment : test::plan_text("G01 X100 F3000\n")) {
      segments.push(std::move(segment));
    }
    segments.close();
  }
  /// One period; what it allocates is counted.
  motion::Status step() {
    const std::int64_t before = test::allocations();
    control.update(t);
    const motion::Status status = interpolator.step(point);
    control.show({});
    allocated += test::allocations() - before;
    t += kPeriod;
    return status;
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      step();
    }
  }
  /// Offers the same plan again at a place of the hold, some time into it.
  void offer_hold(double time) {
    ReplanOffer offer;
    offer.at = {1, 0, 2, time};
    offer.distance = 1.58 + 50.0 * time;  // [mm]
    link.offer(offer);
  }

  SegmentQueue segments{10, 10};
  motion::Interpolator interpolator{segments, kPeriod};
  ReplanLink link;
  OperatorPanel panel;
  FeedControl control{
      interpolator,
      segments,
      link,
      panel,
      {.schedule = {}, .ramp = {2450.0, 50000.0}, .period = kPeriod, .is_wall_clock = true}};
  motion::SetPoint point;
  double t = 0.0;  // [s]
  std::int64_t allocated = 0;
};

TEST_F(FeedControlTest, AsksOnceForAnotherOverride) {
  steps(300);
  EXPECT_EQ(link.request(), nullptr);
  panel.set_override(50.0);
  steps(20);
  const ReplanRequest* request = link.request();
  ASSERT_NE(request, nullptr);
  EXPECT_EQ(request->percent, 50.0);
  EXPECT_FALSE(request->is_at_rest);
  EXPECT_EQ(request->margin, 0.1);
}

TEST_F(FeedControlTest, RefusesAnOfferThatComesTooLateAndLeavesMoreRoom) {
  steps(300);
  panel.set_override(50.0);
  steps(1);
  ASSERT_NE(link.request(), nullptr);
  offer_hold(0.05);  // passed by now
  steps(1);
  EXPECT_EQ(link.verdict(), Verdict::kRejected);
  EXPECT_EQ(interpolator.latest_plan(), 0);
  link.close();
  steps(1);
  ASSERT_NE(link.request(), nullptr);
  EXPECT_EQ(link.request()->margin, 0.2);
}

TEST_F(FeedControlTest, AHoldRefusesWhatWasOfferedAndAsksFromRestAfterwards) {
  steps(300);
  panel.set_override(50.0);
  steps(1);
  panel.hold(true);
  offer_hold(1.0);
  while (step() == motion::Status::kMoving) {
  }
  EXPECT_EQ(link.verdict(), Verdict::kRejected);
  EXPECT_TRUE(control.is_hold());
  EXPECT_EQ(point.feedrate, 0.0);
  link.close();
  steps(50);
  EXPECT_EQ(link.request(), nullptr);
  panel.hold(false);
  steps(1);
  ASSERT_NE(link.request(), nullptr);
  EXPECT_TRUE(link.request()->is_at_rest);
  EXPECT_EQ(link.request()->percent, 50.0);
}

TEST_F(FeedControlTest, AllocatesNothing) {
  steps(200);
  panel.set_override(150.0);
  steps(2);
  offer_hold(0.05);
  steps(2);
  link.close();
  panel.hold(true);
  steps(100);
  panel.hold(false);
  steps(2);
  ASSERT_NE(link.request(), nullptr);
  link.offer({ReplanOffer::Kind::kPathEnd, {}, 0.0});
  steps(2);
  EXPECT_EQ(allocated, 0);
}

}  // namespace feed_control_test
}  // namespace twin::runtime
