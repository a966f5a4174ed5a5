#include <gtest/gtest.h>

#include <cmath>

#include "interpolator/interpolator.hpp"
#include "runtime/segment_queue.hpp"
#include "tests/runtime/planned.hpp"
#include "tests/runtime/trace_rows.hpp"

// Braking may be asked for at any instant, also while the path is coming to its end anyway.
namespace twin::runtime {
namespace {

constexpr double kPeriod = 1e-3;  // [s]
constexpr std::int64_t kMostPeriods = 20000;

/// What an interpolator does when it is told to brake before one step, and to go on afterwards.
struct Braked {
  std::vector<double> distance;  ///< along the path after every step, from chords [mm]
  double braked_at = -1.0;       ///< where it came to rest [mm]; negative: it did not
  Vec3 end = Vec3::Zero();       ///< last set point [mm]
  bool is_done = false;
};

Braked brake_before_step(const std::vector<feedrate::PlannedSegment>& planned, std::int64_t step,
                         const feedrate::RampLimits& limits) {
  SegmentQueue segments(planned.size());
  for (feedrate::PlannedSegment segment : planned) {
    segments.push(std::move(segment));
  }
  segments.close();
  interpolator::Interpolator interpolator(segments, kPeriod);
  interpolator::SetPoint point;
  Braked braked;
  double s = 0.0;
  for (std::int64_t i = 0; i < kMostPeriods; ++i) {
    if (i == step) {
      interpolator.brake(limits);
    }
    const Vec3 before = point.position;
    const interpolator::Status status = interpolator.step(point);
    if (status == interpolator::Status::kDone) {
      braked.is_done = true;
      break;
    }
    if (status == interpolator::Status::kAtRest) {
      braked.braked_at = s;
      interpolator.resume();
      continue;
    }
    s += (point.position - before).norm();
    braked.distance.push_back(s);
  }
  braked.end = point.position;
  return braked;
}

TEST(Brake, AtEveryInstantOfALineItComesToRestAndGoesOnToTheEnd) {
  const Limits limits;
  const auto planned = test::plan_text("G01 X4 F3000\nX5\nX5.2\nX6\nX12\n");
  for (std::int64_t step = 1; step < 400; ++step) {
    const Braked braked = brake_before_step(planned, step, {limits.acceleration, limits.jerk});
    ASSERT_TRUE(braked.is_done) << "braking before step " << step;
    ASSERT_NEAR(braked.end.x(), 12.0, 1e-9) << "braking before step " << step;
    SCOPED_TRACE(step);
    test::expect_within_limits(braked.distance, kPeriod, limits, 50.0, 0.1);
    if (testing::Test::HasFatalFailure()) {
      return;
    }
  }
}

TEST(Brake, AtEveryInstantAcrossCornersAndArcsItComesToRestAndGoesOnToTheEnd) {
  const Limits limits;
  const auto planned = test::plan_text("G01 X3 F3000\nG03 X5 Y2 R2\nG01 Y4\nX0\nG04 P0.02\nY0\n");
  for (std::int64_t step = 1; step < 900; step += 3) {
    const Braked braked = brake_before_step(planned, step, {limits.acceleration, limits.jerk});
    ASSERT_TRUE(braked.is_done) << "braking before step " << step;
    ASSERT_LT(braked.end.norm(), 1e-9) << "braking before step " << step;
  }
}

}  // namespace
}  // namespace twin::runtime
