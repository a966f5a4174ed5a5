#include "hal/rig/boards/voltage_range.hpp"

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

#include "hal/dac.hpp"

namespace twin::hal::rig::boards {
namespace voltage_range_test {

// Range codes of the converters: 0 +-5, 1 +-10, 2 0 to 5, 3 0 to 10 V.
TEST(VoltageRange, EndsOfEveryOutputRange) {
  const std::vector<std::tuple<int, double, double>> ranges{
      {0, -5.0, 5.0}, {1, -10.0, 10.0}, {2, 0.0, 5.0}, {3, 0.0, 10.0}};
  for (const auto& [code_of_range, low, high] : ranges) {
    const auto word = static_cast<std::uint16_t>(code_of_range);
    const VoltageRange range = analogue_output_range(word, 0);
    const double lsb = (high - low) / 65536.0;
    EXPECT_EQ(volts(range, 0x0000), low) << code_of_range;
    EXPECT_EQ(volts(range, 0x8000), 0.5 * (low + high)) << code_of_range;
    EXPECT_EQ(volts(range, 0xFFFF), high - lsb) << code_of_range;
    const VoltageRange other = analogue_output_range(static_cast<std::uint16_t>(word << 8), 1);
    EXPECT_EQ(volts(other, 0xFFFF), high - lsb) << "channel 1, " << code_of_range;
  }
}

TEST(VoltageRange, ChannelsHaveRangesOfTheirOwn) {
  EXPECT_EQ(volts(analogue_output_range(0x0103, 0), 0), 0.0);
  EXPECT_EQ(volts(analogue_output_range(0x0103, 1), 0), -10.0);
}

TEST(VoltageRange, ExternalReferencesAndTheHolesGiveNothing) {
  for (int range = 4; range < 8; ++range) {
    for (int code_of_output : {0x0000, 0x1234, 0xFFFF}) {
      EXPECT_EQ(volts(analogue_output_range(static_cast<std::uint16_t>(range), 0),
                      static_cast<std::uint16_t>(code_of_output)),
                0.0);
    }
  }
}

TEST(VoltageRange, TenVoltsBipolarIsTheConverterOfTheTable) {
  const Dac dac(16);
  const VoltageRange range = analogue_output_range(0x0101, 0);
  for (int code_of_output = 0; code_of_output < 65536; ++code_of_output) {
    ASSERT_EQ(volts(range, static_cast<std::uint16_t>(code_of_output)), dac.volts(code_of_output));
  }
}

TEST(VoltageRange, EndsOfEveryInputRange) {
  const std::vector<std::tuple<int, double, double>> ranges{
      {0x00, -5.0, 5.0},     {0x01, -2.5, 2.5}, {0x02, -1.25, 1.25},
      {0x03, -0.625, 0.625}, {0x04, -10., 10.}, {0x10, 0.0, 10.0},
      {0x11, 0.0, 5.0},      {0x12, 0.0, 2.5},  {0x13, 0.0, 1.25}};
  for (const auto& [gain, low, high] : ranges) {
    const VoltageRange range = analogue_input_range(static_cast<std::uint16_t>(gain));
    EXPECT_EQ(code(range, low), 0x0000) << gain;
    EXPECT_EQ(code(range, 0.5 * (low + high)), 0x8000) << gain;
    EXPECT_EQ(code(range, high), 0xFFFF) << gain;
    EXPECT_EQ(code(range, low - 3.0), 0x0000) << gain;
    EXPECT_EQ(code(range, high + 3.0), 0xFFFF) << gain;
  }
}

}  // namespace voltage_range_test
}  // namespace twin::hal::rig::boards
