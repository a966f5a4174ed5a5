#include "runtime/override_schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace twin::runtime {
namespace override_schedule_test {

using ::testing::HasSubstr;

TEST(OverrideSchedule, IsSecondsAndPercent) {
  const auto schedule = parse_override_schedule("0:100,2:50,3.5:0,5:150");
  ASSERT_TRUE(schedule) << to_string(schedule.error());
  ASSERT_EQ(schedule->size(), 4U);
  EXPECT_EQ((*schedule)[2].time, 3.5);
  EXPECT_EQ((*schedule)[2].percent, 0.0);
  EXPECT_EQ((*schedule)[3].percent, 150.0);
}

TEST(OverrideSchedule, WhatIsWrongIsNamed) {
  const std::vector<std::pair<const char*, const char*>> bad{
      {"", "SECONDS:PERCENT"},         {"1", "'1' is not"},
      {"1:", "'1:' is not"},           {"1:x", "'1:x' is not"},
      {"1:50,", "'' is not"},          {"1:50:60", "'1:50:60' is not"},
      {"nan:50", "'nan:50' is not"},   {"1:inf", "'1:inf' is not"},
      {"-1:50", "before the first"},   {"1:200.5", "within 0 and 200 %"},
      {"1:-5", "within 0 and 200 %"},  {"2:50,1:60", "have to ascend"},
      {"2:50,2:60", "have to ascend"}, {"1 :50", "is not"}};
  for (const auto& [text, says] : bad) {
    const auto schedule = parse_override_schedule(text);
    ASSERT_FALSE(schedule) << text;
    EXPECT_EQ(schedule.error().code, ErrorCode::kUsage) << text;
    EXPECT_THAT(schedule.error().message, HasSubstr(says)) << text;
  }
}

}  // namespace override_schedule_test
}  // namespace twin::runtime
