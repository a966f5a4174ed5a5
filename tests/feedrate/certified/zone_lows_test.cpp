#include "feedrate/certified/zone_lows.hpp"

#include <gtest/gtest.h>

#include <random>

namespace twin::feedrate {
namespace zone_lows_test {

/// Zones with limits among a few values, so that many are equal.
std::vector<LimitZone> random_zones(std::size_t count, std::mt19937& random) {
  std::uniform_int_distribution<int> limit(1, 9);
  std::vector<LimitZone> zones(count);
  for (LimitZone& zone : zones) {
    zone.limit = limit(random);
  }
  return zones;
}

TEST(ZoneLows, AreThoseThatLookingAtEachZoneFinds) {
  std::mt19937 random(7);
  ZoneLows lows;
  for (int round = 0; round < 500; ++round) {
    const auto zones = random_zones(1 + random() % 100, random);
    lows.find(zones);
    const std::size_t first = random() % zones.size();
    const std::size_t last = first + 1 + random() % (zones.size() - first);
    const double most = 0.5 + static_cast<double>(random() % 9);
    std::size_t next = first;
    while (next < last && zones[next].limit > most) {
      ++next;
    }
    EXPECT_EQ(lows.next(first, last, most), next);
    const std::size_t lowest = lows.lowest(first, last);
    const std::size_t middle = first + (last - first) / 2;
    const auto off = [&](std::size_t i) { return i > middle ? i - middle : middle - i; };
    ASSERT_GE(lowest, first);
    ASSERT_LT(lowest, last);
    for (std::size_t i = first; i < last; ++i) {
      EXPECT_GE(zones[i].limit, zones[lowest].limit);
      if (zones[i].limit == zones[lowest].limit) {
        EXPECT_GE(off(i), off(lowest));
      }
    }
  }
}

}  // namespace zone_lows_test
}  // namespace twin::feedrate
