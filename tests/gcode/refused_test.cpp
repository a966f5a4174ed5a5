#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "gcode/codes.hpp"
#include "program.hpp"

namespace twin::gcode {
namespace refused_test {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Refused, CodesByNameWithTheirColumn) {
  EXPECT_EQ(error_of("G0 X1\nG0 G41 X2"),
            "line 2:4: G41 (cutter compensation, left) is not supported: expected G40 and the path "
            "of the tool's centre");
  EXPECT_THAT(error_of("G90.1"), HasSubstr("G90.1 (absolute arc centres) is not supported"));
  EXPECT_THAT(error_of("M98"), HasSubstr("M98 (subprogram call) is not supported"));
  EXPECT_THAT(error_of("G81 X1"), HasSubstr("G81 (canned cycle) is not supported"));
}

TEST(Refused, CodesWithoutANameAreNotKnown) {
  EXPECT_EQ(error_of("G1.5"),
            "line 1:1: G1.5 is not known: expected G00 to G04, G05.2, G05.3, G06.2, G06.3, G17 to "
            "G21, G40, G49, G54, G61, G61.1, G64, G80, G90, G91 or G94");
  EXPECT_THAT(error_of("G-1"), StartsWith("line 1:1: G-1 is not known"));
  EXPECT_THAT(error_of("G61.15"), StartsWith("line 1:1: G61.15 is not known"));
  EXPECT_THAT(error_of("G1000"), StartsWith("line 1:1: G1000 is not known"));
  EXPECT_EQ(error_of("M1.5"), "line 1:1: M1.5 is not known: expected M00 to M09 or M30");
  EXPECT_THAT(error_of("M-1"), StartsWith("line 1:1: M-1 is not known"));
}

TEST(Refused, EveryCodeIsEitherUnderstoodOrRefused) {
  const std::string understood_g =
      " 0 1 2 3 4 5.2 5.3 6.2 6.3 17 18 19 20 21 40 49 54 61 61.1 64 80 90 91 94 ";
  const std::string understood_m = " 0 1 2 3 4 5 6 7 8 9 30 ";
  for (int tenths = 0; tenths < 2000; ++tenths) {
    const std::string number = fmt::format("{}", tenths / 10.0);
    const double value = std::stod(number);
    const bool is_g = understood_g.find(fmt::format(" {} ", number)) != std::string::npos;
    const bool is_m = understood_m.find(fmt::format(" {} ", number)) != std::string::npos;
    EXPECT_EQ(find_g(value).has_value(), is_g) << number;
    EXPECT_EQ(find_m(value).has_value(), is_m) << number;
  }
}

TEST(Refused, AxesThatDoNotExistAndLettersThatMeanNothing) {
  for (const char letter : std::string("ABCUVW")) {
    EXPECT_THAT(
        error_of(fmt::format("G0 X1 {}1", letter)),
        HasSubstr(std::string("line 1:7: there is no axis ") + letter + ": only X, Y and Z move"));
  }
  for (const char letter : std::string("DEHLOQ")) {
    EXPECT_THAT(error_of(fmt::format("G0 {}1", letter)), StartsWith("line 1:4: "));
  }
}

TEST(Refused, LettersAndModalGroupsTwiceOnALine) {
  EXPECT_EQ(error_of("G0 X1 x2"), "line 1:7: X appears twice on the line: expected once");
  EXPECT_EQ(error_of("G0 G1 X1"),
            "line 1:4: G0 and G1 on one line belong to the same modal group: expected one");
  EXPECT_EQ(error_of("G61 G64"),
            "line 1:5: G61 and G64 on one line belong to the same modal group: expected one");
  EXPECT_EQ(error_of("M3 M5"),
            "line 1:4: M3 and M5 on one line belong to the same modal group: expected one");
  EXPECT_EQ(blocks_of("G0 G17 G21 G90 G94 G40 G49 G54 G64 X1 M3 M8").size(), 1U);
}

TEST(Refused, CountsThatAreNotWhole) {
  EXPECT_EQ(error_of("N1.5 G0 X1"), "line 1:1: N1.5: expected a whole number, zero or more");
  EXPECT_EQ(error_of("T-1"), "line 1:1: T-1: expected a whole number, zero or more");
  EXPECT_EQ(error_of("S-1"), "line 1:1: S-1: expected zero or more");
  EXPECT_EQ(error_of("G64 P-0.1"), "line 1:5: P-0.1: expected zero or more");
}

TEST(Refused, ArcWordsWithoutAnArc) {
  EXPECT_EQ(error_of("G0 X1 I1"), "line 1:7: an arc's I, J, K or R needs G02 or G03 in force");
  EXPECT_EQ(error_of("G1 F1 X1 R1"), "line 1:10: an arc's I, J, K or R needs G02 or G03 in force");
}

}  // namespace refused_test
}  // namespace twin::gcode
