#include "core/units.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace twin::units {
namespace units_test {

TEST(Units, KnownPairs) {
  EXPECT_DOUBLE_EQ(mm_per_s_from_mm_per_min(3000.0), 50.0);
  EXPECT_DOUBLE_EQ(mm_per_min_from_mm_per_s(50.0), 3000.0);
  EXPECT_DOUBLE_EQ(um_from_mm(0.01), 10.0);
  EXPECT_DOUBLE_EQ(mm_from_um(10.0), 0.01);
  EXPECT_DOUBLE_EQ(m_from_mm(200.0), 0.2);
  EXPECT_DOUBLE_EQ(mm_from_m(0.2), 200.0);
  EXPECT_DOUBLE_EQ(s_from_ms(0.125), 0.000125);
  EXPECT_DOUBLE_EQ(rad_from_deg(90.0), std::numbers::pi / 2.0);
  EXPECT_DOUBLE_EQ(deg_from_rad(std::numbers::pi), 180.0);
  EXPECT_DOUBLE_EQ(10.0 * kMmPerInch, 254.0);
}

TEST(Units, WayOutAndBackIsTheSame) {
  for (double x : {-1e6, -3.7, 0.0, 1e-9, 0.1, 12000.0}) {
    EXPECT_DOUBLE_EQ(mm_per_min_from_mm_per_s(mm_per_s_from_mm_per_min(x)), x);
    EXPECT_DOUBLE_EQ(um_from_mm(mm_from_um(x)), x);
    EXPECT_DOUBLE_EQ(mm_from_m(m_from_mm(x)), x);
    EXPECT_DOUBLE_EQ(deg_from_rad(rad_from_deg(x)), x);
  }
}

}  // namespace units_test
}  // namespace twin::units
