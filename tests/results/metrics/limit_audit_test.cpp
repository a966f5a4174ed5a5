#include "results/metrics/limit_audit.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "trajectories.hpp"

namespace twin::results {
namespace limit_audit_test {

constexpr double kPeriod = 0.001;

template <class Path>
AuditPeaks audit(const std::vector<double>& distances, const Path& path) {
  LimitAudit audit(kPeriod, Limits{});
  for (const double s : distances) {
    audit.add(path(s));
  }
  return audit.finish();
}

TEST(LimitAudit, StraightMoveReachesItsLimitsAndNoMore) {
  const auto s = s_curve(60.0, 150.0, 2450.0, 50000.0, kPeriod);
  const AuditPeaks peaks = audit(s, [](double q) { return Vec3(0.6 * q, -0.8 * q, 0.0); });
  EXPECT_NEAR(peaks.feedrate, 150.0, 1e-6);
  EXPECT_NEAR(peaks.tangential_acceleration, 2450.0, 1e-3);
  EXPECT_NEAR(peaks.tangential_jerk, 50000.0, 1.0);
  EXPECT_NEAR(peaks.vector_jerk, 50000.0, 1.0);
  EXPECT_LT(peaks.normal_acceleration, 1e-3);
  EXPECT_NEAR(peaks.axis[0].velocity, 90.0, 1e-6);
  EXPECT_NEAR(peaks.axis[1].acceleration, 1960.0, 1e-3);
  EXPECT_NEAR(peaks.axis[1].jerk, 40000.0, 1.0);
  EXPECT_EQ(peaks.axis[2].velocity, 0.0);
}

TEST(LimitAudit, CircleAtFullNormalAccelerationKeepsItsTangentialPeaks) {
  for (const double v : {10.0, 20.0, 50.0}) {
    const double radius = v * v / 2450.0;
    // gentle enough that acceleration 1000 and jerk 50000 are reached
    const auto s = s_curve(40.0, v, 400.0, 50000.0, kPeriod);
    const AuditPeaks peaks = audit(s, [&](double q) {
      return Vec3(radius * std::cos(q / radius), radius * std::sin(q / radius), 0.0);
    });
    EXPECT_NEAR(peaks.feedrate / v, 1.0, 1e-3) << v;
    EXPECT_NEAR(peaks.normal_acceleration / 2450.0, 1.0, 4e-3) << v;
    EXPECT_NEAR(peaks.tangential_acceleration / 400.0, 1.0, 1e-2) << v;
    EXPECT_NEAR(peaks.tangential_jerk / 50000.0, 1.0, 1e-2) << v;
  }
}

TEST(LimitAudit, ExactStopsAtCornersAreNoJerk) {
  for (const double degrees : {45.0, 90.0, 135.0, 180.0}) {
    LimitAudit audit(kPeriod, Limits{});
    Vec3 at = Vec3::Zero();
    double heading = 0.0;
    for (const double length : {33.0, 20.0, 29.0}) {
      const Vec3 direction(std::cos(heading), std::sin(heading), 0.0);
      const auto s = s_curve(length, 50.0, 500.0, 50000.0, kPeriod);
      for (const double q : s) {
        audit.add(at + q * direction);
      }
      at += s.back() * direction;
      heading += degrees * std::numbers::pi / 180.0;
    }
    const AuditPeaks peaks = audit.finish();
    EXPECT_NEAR(peaks.tangential_acceleration, 500.0, 1.0) << degrees;
    EXPECT_NEAR(peaks.tangential_jerk, 50000.0, 100.0) << degrees;
  }
}

TEST(LimitAudit, CornerPassedAtSpeedIsNormalAcceleration) {
  // 90 deg between two set points at 10 mm/s: the velocity vector changes by 10 sqrt(2) mm/s within
  // a period
  const auto s = s_curve(30.0, 10.0, 500.0, 50000.0, kPeriod);
  const double corner = s[s.size() / 2];
  const AuditPeaks peaks = audit(
      s, [&](double q) { return q < corner ? Vec3(q, 0.0, 0.0) : Vec3(corner, q - corner, 0.0); });
  EXPECT_NEAR(peaks.normal_acceleration, 10.0 * std::sqrt(2.0) / kPeriod, 20.0);
  EXPECT_NEAR(peaks.axis[0].acceleration, 10.0 / kPeriod, 1e-3);
}

TEST(LimitAudit, ArcBetweenLinesDoesNotCryWolf) {
  const auto s = s_curve(30.0, 50.0, 1000.0, 50000.0, kPeriod);
  constexpr double kRadius = 1.02;
  constexpr double kFirst = 12.3451;
  constexpr double kSweep = 1.7;
  const AuditPeaks peaks = audit(s, [&](double q) {
    const double a = std::clamp((q - kFirst) / kRadius, 0.0, kSweep);
    const double after = std::max(q - kFirst - kRadius * kSweep, 0.0);
    return Vec3(std::min(q, kFirst) + kRadius * std::sin(a) + after * std::cos(kSweep),
                kRadius * (1 - std::cos(a)) + after * std::sin(kSweep), 0.0);
  });
  EXPECT_LT(peaks.tangential_acceleration, 1000.0 * 1.02);
  EXPECT_LT(peaks.tangential_jerk, 50000.0 * 1.05);
  EXPECT_NEAR(peaks.normal_acceleration, 2500.0 / kRadius, 10.0);
}

TEST(LimitAudit, TrajectoryThatStartsAtSpeedShows) {
  LimitAudit audit(kPeriod, Limits{});
  for (int i = 0; i < 100; ++i) {
    audit.add({0.05 * i, 0.0, 0.0});
  }
  EXPECT_NEAR(audit.peaks().tangential_acceleration, 50.0 / kPeriod, 1e-3);
  audit.finish();
  EXPECT_NEAR(audit.peaks().axis[0].jerk, 50.0 / (kPeriod * kPeriod), 1.0);
}

TEST(LimitAudit, JumpOfTwoMicrometresIsFound) {
  auto s = s_curve(40.0, 50.0, 1000.0, 50000.0, kPeriod);
  for (std::size_t i = 300; i < s.size(); ++i) {
    s[i] += 0.002;
  }
  const AuditPeaks peaks = audit(s, [](double q) { return Vec3(q, 0.0, 0.0); });
  EXPECT_NEAR(peaks.tangential_acceleration, 0.002 / kPeriod / kPeriod, 1.0);
  EXPECT_NEAR(peaks.tangential_jerk / (2 * 0.002 / std::pow(kPeriod, 3)), 1.0, 1e-3);
}

TEST(LimitAudit, NothingAddedIsNoMotion) {
  LimitAudit audit(kPeriod, Limits{});
  EXPECT_EQ(audit.finish().feedrate, 0.0);
}

}  // namespace limit_audit_test
}  // namespace twin::results
