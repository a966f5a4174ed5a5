#include "operator/commands.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/json.hpp"

namespace twin::operator_station {
namespace commands_test {

using ::testing::HasSubstr;

TEST(Commands, SetTheOverrideAndTheHoldAndAnswerWithTheStatus) {
  runtime::OperatorPanel panel;
  const Json halved = parse_json(answer("override 50", panel));
  EXPECT_EQ(panel.wish().percent, 50.0);
  EXPECT_EQ(halved.at("override_percent"), 50.0);
  EXPECT_EQ(halved.at("state"), "waiting");
  answer("  hold\r", panel);
  EXPECT_TRUE(panel.wish().holds());
  EXPECT_EQ(parse_json(answer("resume", panel)).at("hold"), false);
  EXPECT_FALSE(panel.wish().holds());
  panel.show({runtime::MotionState::kMoving, 1.5, 50.0, 12.5, 42});
  const Json status = parse_json(answer("status", panel));
  EXPECT_EQ(status.at("state"), "moving");
  EXPECT_EQ(status.at("t_s"), 1.5);
  EXPECT_EQ(status.at("planned_for_percent"), 50.0);
  EXPECT_EQ(status.at("feedrate_mm_per_s"), 12.5);
  EXPECT_EQ(status.at("line"), 42);
}

TEST(Commands, WhatIsNotUnderstoodChangesNothingAndSaysWhatIs) {
  runtime::OperatorPanel panel;
  for (const char* line : {"override", "override x", "override 201", "override -1", "override nan",
                           "override 50 60", "override inf", "override 0x10"}) {
    const Json bad = parse_json(answer(line, panel));
    EXPECT_THAT(bad.at("error"), HasSubstr("within 0 and 200")) << line;
  }
  for (const char* line : {"", "stop", "hold 5", "HOLD", "status now", "\x01\xff"}) {
    const Json bad = parse_json(answer(line, panel));
    EXPECT_THAT(bad.at("error"), HasSubstr("override PERCENT, hold, resume, status")) << line;
  }
  EXPECT_EQ(panel.wish().percent, 100.0);
  EXPECT_FALSE(panel.wish().is_held);
}

TEST(Commands, ResumeDoesNotEndAnOverrideOfNothing) {
  runtime::OperatorPanel panel;
  answer("override 0", panel);
  EXPECT_TRUE(panel.wish().holds());
  EXPECT_TRUE(parse_json(answer("resume", panel)).contains("error"));
  EXPECT_TRUE(panel.wish().holds());
}

TEST(Keys, ChangeTheOverrideWithinItsRangeAndToggleTheHold) {
  runtime::OperatorPanel panel;
  press('+', panel);
  EXPECT_EQ(panel.wish().percent, 110.0);
  press('-', panel);
  press('-', panel);
  EXPECT_EQ(panel.wish().percent, 90.0);
  press('3', panel);
  EXPECT_EQ(panel.wish().percent, 30.0);
  for (int i = 0; i < 50; ++i) {
    press('+', panel);
  }
  EXPECT_EQ(panel.wish().percent, 200.0);
  for (int i = 0; i < 50; ++i) {
    press('-', panel);
  }
  EXPECT_EQ(panel.wish().percent, 0.0);
  press('0', panel);
  EXPECT_EQ(panel.wish().percent, 100.0);
  press(' ', panel);
  EXPECT_TRUE(panel.wish().is_held);
  press('x', panel);
  press(' ', panel);
  EXPECT_FALSE(panel.wish().is_held);
}

}  // namespace commands_test
}  // namespace twin::operator_station
