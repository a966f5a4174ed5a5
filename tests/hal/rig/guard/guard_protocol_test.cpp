#include "hal/rig/guard/guard_protocol.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace twin::hal::rig::guard {
namespace guard_protocol_test {

const GuardArguments kArguments{
    .page = 5, .lifeline = 7, .outputs = "shared:/a rig", .safe_digital = 0x00A0, .timeout_ms = 20};

Expected<GuardArguments> parse(const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) {
    pointers.push_back(text.c_str());
  }
  return parse_guard_arguments(pointers);
}

std::string refusal_of(const std::vector<std::string>& texts) {
  const auto arguments = parse(texts);
  return arguments ? "none" : arguments.error().message;
}

TEST(GuardArguments, AreTheSameAfterTheirTexts) {
  const auto again = parse(to_text(kArguments));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->page, 5);
  EXPECT_EQ(again->lifeline, 7);
  EXPECT_EQ(again->outputs, "shared:/a rig");
  EXPECT_EQ(again->safe_digital, 0x00A0u);
  EXPECT_EQ(again->timeout_ms, 20);
}

TEST(GuardArguments, EachFlagIsNeededAndTakenOnce) {
  std::vector<std::string> texts = to_text(kArguments);
  texts.resize(texts.size() - 2);
  EXPECT_EQ(refusal_of(texts), "--timeout-ms is missing");
  texts.push_back("--page");
  EXPECT_EQ(refusal_of(texts), "--page has no value");
  texts.push_back("5");
  EXPECT_EQ(refusal_of(texts), "--page is given twice");
  EXPECT_EQ(refusal_of({"--verbose", "1"}), "\"--verbose\" is no flag of twin-guard");
  EXPECT_EQ(refusal_of({}), "--page is missing");
}

TEST(GuardArguments, NumbersAreWholeAndInRange) {
  for (const std::string text : {"", "-1", "x", "20ms", "2.5", "99999999999999999999"}) {
    std::vector<std::string> texts = to_text(kArguments);
    texts.back() = text;
    EXPECT_EQ(refusal_of(texts),
              "--timeout-ms is \"" + text + "\", not a whole number from 0 to 2147483647");
  }
  GuardArguments wide = kArguments;
  wide.safe_digital = 0x10000;
  EXPECT_EQ(refusal_of(to_text(wide)),
            "--safe-digital is \"65536\", not a whole number from 0 to 65535");
}

}  // namespace guard_protocol_test
}  // namespace twin::hal::rig::guard
