#include "config/machine_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace twin::config {
namespace overrides_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string refusal(std::string_view text) {
  MachineFile machine;
  const auto done = apply_override(machine, text);
  EXPECT_FALSE(done) << text;
  if (done) {
    return "";
  }
  EXPECT_EQ(exit_status(done.error()), 2);
  return done.error().message;
}

TEST(Overrides, ChangeOneValueAndNoOther) {
  MachineFile machine;
  const std::string before = to_toml(machine);
  ASSERT_TRUE(apply_override(machine, "limits.jerk=12345"));
  EXPECT_DOUBLE_EQ(machine.limits.jerk, 12345.0);
  machine.limits.jerk = Limits{}.jerk;
  EXPECT_EQ(to_toml(machine), before);
}

TEST(Overrides, TakeEveryKindOfValue) {
  MachineFile machine;
  ASSERT_TRUE(apply_override(machine, "interpolator.period_ms = 0.5"));
  EXPECT_DOUBLE_EQ(machine.period, 0.0005);
  ASSERT_TRUE(apply_override(machine, "planning.look_ahead=50"));
  EXPECT_EQ(machine.path.look_ahead, 50);
  ASSERT_TRUE(apply_override(machine, "limits.travel_max=[1, 2.5, 3]"));
  EXPECT_EQ(machine.limits.travel_max, Vec3(1.0, 2.5, 3.0));
  ASSERT_TRUE(apply_override(machine, "table.model=other.xml"));
  EXPECT_EQ(machine.table.model, "other.xml");
  ASSERT_TRUE(apply_override(machine, "table.model=\"quoted.xml\""));
  EXPECT_EQ(machine.table.model, "quoted.xml");
  ASSERT_TRUE(apply_override(machine, "servo.x.kp=7"));
  EXPECT_DOUBLE_EQ(machine.servo[hal::kX].kp, 7.0);
  EXPECT_DOUBLE_EQ(machine.servo[hal::kY].kp, motion::Gains{}.kp);
}

TEST(Overrides, ChooseAFeedrateRuleByName) {
  MachineFile machine;
  ASSERT_TRUE(apply_override(machine, "planning.feedrate_rule=contact_speed"));
  EXPECT_EQ(machine.planning.feedrate_rule, FeedrateRule::kContactSpeed);
  ASSERT_TRUE(apply_override(machine, "planning.tool_radius=2.5"));
  EXPECT_DOUBLE_EQ(machine.planning.tool_radius, 2.5);
  ASSERT_TRUE(apply_override(machine, "planning.tool_side=right"));
  EXPECT_EQ(machine.planning.tool_side, ToolSide::kRight);
  EXPECT_THAT(refusal("planning.feedrate_rule=servo"), HasSubstr("constant, chord_error"));
}

TEST(Overrides, ChooseAnAccelerationProfileByName) {
  MachineFile machine;
  ASSERT_TRUE(apply_override(machine, "planning.acceleration_profile=fir"));
  EXPECT_EQ(machine.planning.acceleration_profile, AccelerationProfile::kFir);
  EXPECT_THAT(refusal("planning.acceleration_profile=scurve"), HasSubstr("did you mean s_curve?"));
}

TEST(Overrides, TyposSuggestTheNearestKey) {
  EXPECT_THAT(refusal("limits.jrek=1"),
              HasSubstr("unknown key limits.jrek; did you mean limits.jerk?"));
  EXPECT_THAT(refusal("limit.acceleration_mm_per_s2=1"),
              HasSubstr("did you mean limits.acceleration_mm_per_s2?"));
  EXPECT_THAT(refusal("servo.q.kp=1"), HasSubstr("did you mean servo.x.kp?"));
}

TEST(Overrides, BadValuesAreRefused) {
  EXPECT_THAT(refusal("limits.jerk=fast"), HasSubstr("\"fast\" is not a number"));
  EXPECT_THAT(refusal("limits.jerk="), HasSubstr("is not a number"));
  EXPECT_THAT(refusal("limits.jerk=nan"), HasSubstr("finite"));
  EXPECT_THAT(refusal("limits.jerk=1e300"), HasSubstr("out of range"));
  EXPECT_THAT(refusal("planning.look_ahead=99999999999"), HasSubstr("out of range"));
  EXPECT_THAT(refusal("planning.look_ahead=99999999999999999999999"),
              HasSubstr("not a whole number"));
  EXPECT_THAT(refusal("limits.jerk=1\nlimits.acceleration=2"), HasSubstr("not a number"));
}

TEST(Overrides, WhatIsNoAssignmentIsRefused) {
  for (const char* text : {"", "=", "limits", "limits.jerk", "jerk=1", ".=", "."}) {
    EXPECT_THAT(refusal(text),
                testing::AnyOf(HasSubstr("section.key=value"), HasSubstr("unknown key")))
        << text;
  }
}

TEST(Overrides, WhatTheySayTogetherIsChecked) {
  MachineFile machine;
  const std::vector<std::string> texts{"limits.travel_min=[0, 0, 0]",
                                       "limits.travel_max=[1, 1, -1]"};
  const auto done = apply_overrides(machine, texts);
  ASSERT_FALSE(done);
  EXPECT_EQ(exit_status(done.error()), 2);
  EXPECT_THAT(done.error().message, HasSubstr("in z"));
}

TEST(Overrides, AFormerNameIsUnderstoodAndNoted) {
  MachineFile machine;
  ASSERT_TRUE(apply_overrides(
      machine, std::vector<std::string>{"planning.planner=paper", "interpolator.kind=linear"}));
  EXPECT_EQ(machine.path.curves, CurveKind::kNone);
  EXPECT_THAT(machine.notes, ElementsAre("interpolator.kind is now called path.curves"));
  MachineFile present;
  ASSERT_TRUE(apply_overrides(
      present, std::vector<std::string>{"planning.planner=paper", "path.curves=linear"}));
  EXPECT_EQ(present.path.curves, CurveKind::kNone);
  EXPECT_THAT(present.notes, IsEmpty());
}

TEST(Overrides, WhatTheCertifiedPlannerDoesNotHaveMakesThePlannerThePapersWithANote) {
  for (const char* text :
       {"path.curves=bezier", "path.curves=linear", "planning.acceleration_profile=s_curve",
        "planning.acceleration_profile=fir", "planning.feedrate_rule=constant",
        "planning.feedrate_rule=contact_speed"}) {
    MachineFile machine;
    ASSERT_TRUE(apply_overrides(machine, std::vector<std::string>{text}));
    EXPECT_EQ(machine.path.planner, Planner::kPaper) << text;
    std::string setting(text);
    setting.replace(setting.find('='), 1, " = ");
    EXPECT_THAT(machine.notes,
                ElementsAre(HasSubstr("planning.planner = paper, because " + setting)));
  }
  for (const char* text : {"path.curves=nurbs", "planning.acceleration_profile=trapezoidal",
                           "planning.feedrate_rule=chord_error"}) {
    MachineFile machine;
    ASSERT_TRUE(apply_overrides(machine, std::vector<std::string>{text}));
    EXPECT_EQ(machine.path.planner, Planner::kCertified) << text;
    EXPECT_THAT(machine.notes, IsEmpty()) << text;
  }
}

TEST(Overrides, TheVectorOfTheJerkIsRefusedWithThePapersPlanner) {
  for (const char* text : {"planning.planner=paper", "path.curves=bezier"}) {
    MachineFile machine;
    const auto done =
        apply_overrides(machine, std::vector<std::string>{"limits.jerk_of=vector", text});
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("limits.jerk_of = vector, but"));
  }
}

TEST(Overrides, AskingForTheCertifiedPlannerAndWhatItDoesNotHaveIsRefused) {
  MachineFile machine;
  const auto done = apply_overrides(
      machine, std::vector<std::string>{"planning.planner=certified", "path.curves=bezier"});
  ASSERT_FALSE(done);
  EXPECT_EQ(exit_status(done.error()), 2);
  EXPECT_THAT(done.error().message,
              HasSubstr("planning.planner = certified does not have path.curves = bezier"));
  MachineFile paper;
  EXPECT_TRUE(apply_overrides(
      paper, std::vector<std::string>{"planning.planner=paper", "path.curves=bezier"}));
  EXPECT_THAT(paper.notes, IsEmpty());
}

TEST(Overrides, ThatThePapersPlannerKeepsNoLimitsOfAxesIsSaid) {
  MachineFile machine;
  ASSERT_TRUE(apply_overrides(
      machine, std::vector<std::string>{"limits.axis_jerk=[9e3,9e3,0]", "planning.planner=paper"}));
  EXPECT_THAT(machine.notes, ElementsAre(HasSubstr("paper does not keep limits.axis_feedrate")));
}

TEST(Overrides, LaterOnesWin) {
  MachineFile machine;
  const std::vector<std::string> texts{"limits.jerk=1000", "limits.jerk_mm_per_s3=2000"};
  ASSERT_TRUE(apply_overrides(machine, texts));
  EXPECT_DOUBLE_EQ(machine.limits.jerk, 2000.0);
}

}  // namespace overrides_test
}  // namespace twin::config
