#include "plan.hpp"

#include <gtest/gtest.h>

#include "tests/support/blocks.hpp"
#include "tests/support/motion_profile.hpp"

namespace twin::test {
namespace {

constexpr double kPlace = 2e-9;     // rounding of places [mm]
constexpr double kAtRest = 2e-3;    // feedrate within kPlace of rest [mm/s]
constexpr double kFeedrate = 1e-5;  // [mm/s]

void expect_under_zones(const feedrate::PlannedSegment& planned, const MotionProfile& profile) {
  double covered = 0.0;
  for (const feedrate::LimitZone& zone : planned.limits) {
    ASSERT_NEAR(zone.begin, covered, kPlace);
    covered = zone.end;
    const bool is_place = zone.end - zone.begin < 3.0 * kPlace;
    for (int i = 0; i <= 10; ++i) {
      const double s = is_place
                           ? zone.end
                           : zone.begin + kPlace + 0.1 * i * (zone.end - zone.begin - 2 * kPlace);
      ASSERT_LE(profile.feedrate_at(s), zone.limit * (1.0 + 1e-6) + (is_place ? kAtRest : 1e-6))
          << "line " << planned.segment.marks.front().line << " s " << s;
    }
  }
  ASSERT_NEAR(covered, planned.segment.length, kPlace);
}

void expect_normal_acceleration(const feedrate::PlannedSegment& planned,
                                const MotionProfile& profile, const Limits& limits) {
  const auto* fitted = std::get_if<path::FittedCurve>(&planned.segment.geometry);
  for (int i = 0; fitted != nullptr && i <= 100; ++i) {
    const double s = 0.01 * i * planned.segment.length;
    const double u = fitted->arc_length.u_at(fitted->curve, s, 0.0);
    const double k = path::point_from(fitted->curve.derivatives(u)).curvature.norm();
    const double v = profile.feedrate_at(s);
    ASSERT_LE(k * v * v, 1.02 * limits.acceleration);
  }
}

/// One segment; `at` is the motion at its start and becomes that at its end.
void expect_whole_segment(const feedrate::PlannedSegment& planned, const Limits& limits,
                          feedrate::PathMotion& at) {
  at.s = 0.0;
  for (const feedrate::Phase& phase : planned.phases) {
    ASSERT_GE(phase.duration, 0.0);
    ASSERT_NEAR(phase.s, at.s, kPlace);
    ASSERT_NEAR(phase.v, at.v, kFeedrate);
    ASSERT_NEAR(phase.a, at.a, 1e-5 * limits.acceleration);
    const double way = feedrate::motion_at(phase, phase.duration).s - phase.s;
    // A ramp may be 1 nm longer than its room: then it is that much steeper.
    ASSERT_LE(std::abs(phase.j) * (way > 1e-6 ? 1.0 : 0.0), limits.jerk * 1.005);
    at = feedrate::motion_at(phase, phase.duration);
    ASSERT_LE(std::abs(at.a), limits.acceleration * 1.001);
    ASSERT_GE(at.v, -kFeedrate);
  }
  ASSERT_NEAR(at.s, planned.segment.length, kPlace);
}

}  // namespace

Plan plan(const std::vector<path::Segment>& segments, const PlanSettings& settings) {
  Plan result;
  PathSettings path = settings.path;
  path.look_ahead = settings.look_ahead;
  feedrate::LookAhead look_ahead(settings.limits, settings.model, path, settings.period,
                                 [&](feedrate::PlannedSegment&& planned) {
                                   for (const feedrate::Phase& phase : planned.phases) {
                                     result.time += phase.duration;
                                   }
                                   result.segments.push_back(std::move(planned));
                                 });
  for (path::Segment segment : segments) {
    look_ahead.push(std::move(segment));
  }
  look_ahead.finish();
  result.fallbacks = look_ahead.fallbacks();
  return result;
}

Plan plan(const std::vector<gcode::Block>& blocks, const PlanSettings& settings) {
  return plan(build(blocks, settings.path, settings.model, settings.limits), settings);
}

void expect_whole(const Plan& plan, const Limits& limits, bool keeps_normal_acceleration) {
  feedrate::PathMotion at{0.0, 0.0, 0.0};
  std::int64_t index = 0;
  for (const feedrate::PlannedSegment& planned : plan.segments) {
    ASSERT_EQ(planned.index, index++);
    if (planned.segment.length == 0.0) {
      ASSERT_EQ(planned.phases.size(), 1U);
      ASSERT_EQ(planned.phases[0].duration, planned.segment.dwell);
      ASSERT_LE(at.v, kAtRest);
      continue;
    }
    ASSERT_NO_FATAL_FAILURE(expect_whole_segment(planned, limits, at));
    if (planned.segment.stops_at_end) {
      ASSERT_LE(at.v, kAtRest);
    }
    const MotionProfile profile(planned.phases);
    ASSERT_NO_FATAL_FAILURE(expect_under_zones(planned, profile));
    if (keeps_normal_acceleration) {
      ASSERT_NO_FATAL_FAILURE(expect_normal_acceleration(planned, profile, limits));
    }
  }
  ASSERT_NEAR(at.v, 0.0, kFeedrate);
  ASSERT_NEAR(at.a, 0.0, 1e-5 * limits.acceleration);
}

}  // namespace twin::test
