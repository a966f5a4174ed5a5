#include "feedrate/certified/dips.hpp"

#include <gtest/gtest.h>

#include "feedrate/certified/glide.hpp"

namespace twin::feedrate {
namespace dips_test {

const RampLimits kRamp{2450.0, 50000.0, AccelerationProfile::kTrapezoidal};

/// Zones of the given widths and limits, one after the other.
std::vector<LimitZone> zones_of(const std::vector<std::pair<double, double>>& parts) {
  std::vector<LimitZone> zones;
  double s = 0.0;
  for (const auto& [width, limit] : parts) {
    zones.push_back({s, s + width, limit});
    s += width;
  }
  return zones;
}

double time_of(const std::vector<LimitZone>& zones) {
  Glide glide;
  EXPECT_TRUE(glide.plan(zones, {zones.front().begin, 0.0}, {zones.back().end, 0.0}, kRamp));
  double time = 0.0;
  for (const Phase& phase : glide.phases()) {
    time += phase.duration;
  }
  return time;
}

double limit_at(const std::vector<LimitZone>& zones, double s) {
  for (const LimitZone& zone : zones) {
    if (s < zone.end) {
      return zone.limit;
    }
  }
  return zones.back().limit;
}

TEST(Dips, AValleyThatIsHeldIsPassedSoonerALittleLower) {
  for (const double width : {0.3, 0.6, 1.5, 4.0}) {
    for (const double valley : {8.0, 20.0, 27.0, 40.0}) {
      auto zones = zones_of({{10.0, 50.0}, {width, valley}, {10.0, 50.0}});
      const auto before = zones;
      add_dips(zones, 0, 50.0, kRamp);
      if (width / valley > 0.3) {
        continue;  // so long that a lower feedrate costs more than it gains
      }
      ASSERT_GT(zones.size(), before.size()) << width << " mm at " << valley;
      EXPECT_EQ(zones.front().begin, before.front().begin);
      EXPECT_EQ(zones.back().end, before.back().end);
      for (std::size_t i = 1; i < zones.size(); ++i) {
        EXPECT_EQ(zones[i].begin, zones[i - 1].end);
      }
      for (double s = 0.005; s < zones.back().end; s += 0.01) {
        EXPECT_LE(limit_at(zones, s), limit_at(before, s));
      }
      EXPECT_LT(time_of(zones), time_of(before)) << width << " mm at " << valley;
    }
  }
}

TEST(Dips, StayOutOfBriefValleysAndOfThoseThatEndTheCurve) {
  for (const auto& parts : std::vector<std::vector<std::pair<double, double>>>{
           {{10.0, 50.0}, {0.02, 20.0}, {10.0, 50.0}},
           {{10.0, 50.0}, {2.0, 20.0}},
           {{2.0, 20.0}, {10.0, 50.0}},
           {{10.0, 50.0}}}) {
    auto zones = zones_of(parts);
    add_dips(zones, 0, 50.0, kRamp);
    EXPECT_EQ(zones.size(), parts.size());
  }
}

}  // namespace dips_test
}  // namespace twin::feedrate
