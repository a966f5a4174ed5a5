#include "hal/dac.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twin::hal {
namespace dac_test {

// Code table of the PCI-1716 in its +-10 V range.
TEST(Dac, SixteenBitCodesAreOffsetBinaryOverTenVolts) {
  const Dac dac(16);
  const double lsb = 20.0 / 65536.0;
  EXPECT_EQ(dac.code(-10.0), 0x0000);
  EXPECT_EQ(dac.code(-lsb), 0x7FFF);
  EXPECT_EQ(dac.code(0.0), 0x8000);
  EXPECT_EQ(dac.code(10.0 - lsb), 0xFFFF);
  EXPECT_EQ(dac.volts(0xFFFF), 10.0 - lsb);
  EXPECT_EQ(dac.volts(0x0000), -10.0);
  EXPECT_EQ(dac.volts(0x8000), 0.0);
}

TEST(Dac, VoltagesBeyondTheRangeSaturate) {
  const Dac dac(16);
  EXPECT_EQ(dac.code(10.0), 0xFFFF);
  EXPECT_EQ(dac.code(1e300), 0xFFFF);
  EXPECT_EQ(dac.code(-1e300), 0x0000);
}

TEST(Dac, EveryCodeComesBackFromItsVoltage) {
  const Dac dac(16);
  for (std::int64_t code = 0; code < 65536; ++code) {
    ASSERT_EQ(dac.code(dac.volts(code)), code);
  }
}

TEST(Dac, ErrorIsAtMostHalfAStep) {
  for (const int bits : {8, 12, 16}) {
    const Dac dac(bits);
    for (int i = 0; i <= 1000; ++i) {
      const double volts = -9.9 + i * 0.0197;
      ASSERT_LE(std::abs(dac.convert(volts) - volts), 0.5 * dac.step() * (1.0 + 1e-9));
    }
  }
}

}  // namespace dac_test
}  // namespace twin::hal
