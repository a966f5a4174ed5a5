#include "hal/rig/emulator/fault.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/machine.hpp"

namespace twin::hal::rig::emulator {
namespace fault_test {

using ::testing::HasSubstr;

TEST(Fault, KindAxisAndTimeAreRead) {
  const Expected<Fault> fault = parse_fault("alarm:y@1.5");
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->kind, FaultKind::kAlarm);
  EXPECT_EQ(fault->axis, static_cast<std::size_t>(kY));
  EXPECT_EQ(fault->time, 1.5);
}

TEST(Fault, EveryKindComesBackFromItsText) {
  for (std::size_t i = 0; i < kFaultKinds; ++i) {
    const auto kind = static_cast<FaultKind>(i);
    const std::string text = to_string(Fault{kind, has_axis(kind) ? kY : kX, 0.25});
    const Expected<Fault> fault = parse_fault(text);
    ASSERT_TRUE(fault) << text;
    EXPECT_EQ(fault->kind, kind);
    EXPECT_EQ(to_string(*fault), text);
  }
}

std::string refusal(std::string_view text) {
  const Expected<Fault> fault = parse_fault(text);
  return fault ? "accepted" : fault.error().message;
}

TEST(Fault, AnUnknownKindIsToldWhichThereAre) {
  const std::string message = refusal("alarn:x@1");
  EXPECT_THAT(message, HasSubstr("'alarn' is no kind of fault"));
  EXPECT_THAT(message, HasSubstr("encoder_frozen"));
  EXPECT_THAT(message, HasSubstr("card_gone_1784"));
}

TEST(Fault, WhatIsMissingIsNamed) {
  EXPECT_THAT(refusal("alarm:x"), HasSubstr("it has no time"));
  EXPECT_THAT(refusal("alarm@1"), HasSubstr("it needs an axis"));
  EXPECT_THAT(refusal("card_gone_1716:x@1"), HasSubstr("takes no axis"));
  EXPECT_THAT(refusal("alarm:z@1"), HasSubstr("axis 'z' is neither x nor y"));
  EXPECT_THAT(refusal(""), HasSubstr("it has no time"));
}

TEST(Fault, ATimeIsANumberFromZeroOn) {
  for (const char* text : {"alarm:x@", "alarm:x@-1", "alarm:x@nan", "alarm:x@inf", "alarm:x@1s"}) {
    EXPECT_THAT(refusal(text), HasSubstr("is no time in seconds")) << text;
  }
}

TEST(Fault, IsAMistakeOfTheCommandLine) {
  EXPECT_EQ(parse_fault("x").error().code, ErrorCode::kUsage);
}

}  // namespace fault_test
}  // namespace twin::hal::rig::emulator
