#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "gcode/words/codes.hpp"
#include "program.hpp"

namespace twin::gcode {
namespace refused_test {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Refused, CodesByNameWithTheirColumn) {
  EXPECT_EQ(error_of("G0 X1\nG0 G38.1 X2"),
            "line 2:4: G38.1 (probing) is not supported: expected G38.2 to G38.5");
  EXPECT_THAT(error_of("G32 Z1 F1"), HasSubstr("G32 (thread cutting) is not supported"));
  EXPECT_THAT(error_of("G51 X2"), HasSubstr("G51 (scaling) is not supported"));
  EXPECT_THAT(error_of("G43.4 H1"),
              HasSubstr("G43.4 (control of the tool's centre point or axis) is not supported"));
  EXPECT_THAT(error_of("M428"), HasSubstr("M428 (switch of kinematics) is not supported"));
  EXPECT_THAT(error_of("M430"), HasSubstr("M430 (switch of kinematics) is not supported"));
  EXPECT_THAT(error_of("M97 P1"), HasSubstr("M97 (subprogram call) is not supported"));
  EXPECT_THAT(error_of("M21"), HasSubstr("M21 (mirror image on some controls) is not supported"));
  EXPECT_THAT(error_of("M47"), HasSubstr("M47 (the program again) is not supported"));
  EXPECT_THAT(error_of("M96 P1"), HasSubstr("M96 (interrupt by a macro) is not supported"));
  EXPECT_THAT(error_of("G87 X1"), HasSubstr("G87 (back boring) is not supported"));
  EXPECT_THAT(error_of("G37 Z1"), HasSubstr("G37 (automatic measurement of a tool)"));
}

TEST(Refused, CornersThatTheControlWouldRound) {
  EXPECT_EQ(error_of("G1 F1 X5 ,R2"),
            "line 1:10: ',R' (a corner rounded or broken) is not supported: expected its moves "
            "written out as G00 to G03");
  EXPECT_EQ(error_of("G1 F1 X5,2"), "line 1:9: unexpected ',': expected a letter and a number");
}

TEST(Refused, CodesWithoutANameAreNotKnown) {
  EXPECT_EQ(error_of("G1.5"),
            "line 1:1: G1.5 is not known: expected G00 to G05.3, G06.2, G06.3, G08 to G10, G15 to "
            "G21, G28, G30, G31, G33, G33.1, G38.2 to G43.2, G49 to G50.1, G51.1 to G59.3, G61, "
            "G61.1, G64, G68, G69, G73, G74, G76, G80 to G86, G89 to G99, G103, G154 or G187");
  EXPECT_THAT(error_of("G-1"), StartsWith("line 1:1: G-1 is not known"));
  EXPECT_THAT(error_of("G61.15"), StartsWith("line 1:1: G61.15 is not known"));
  EXPECT_THAT(error_of("G1000"), StartsWith("line 1:1: G1000 is not known"));
  EXPECT_EQ(error_of("M1.5"),
            "line 1:1: M1.5 is not known: expected a whole number from M00 to M999");
  EXPECT_THAT(error_of("M-1"), StartsWith("line 1:1: M-1 is not known"));
}

TEST(Refused, EveryCodeIsEitherUnderstoodOrRefused) {
  const std::string understood_g =
      " 0 1 2 3 4 5 5.1 5.2 5.3 6.2 6.3 8 9 10 15 16 17 18 19 20 21 28 28.1 30 30.1 31 31.1 31.2 "
      "31.3 33 33.1 38.2 38.3 38.4 38.5 76 103 154 40 41 41.1 42 "
      "42.1 43 43.1 43.2 49 50 50.1 51.1 52 53 54 54.1 55 56 57 58 59 59.1 59.2 59.3 61 61.1 64 65 "
      "66 67 68 69 70 71 73 74 80 81 82 83 84 85 86 89 90 90.1 91 91.1 92 92.1 92.2 92.3 93 94 95 "
      "96 97 "
      "98 99 "
      "187 ";
  const std::string refused_m = " 21 22 25 47 91 92 96 97 428 429 430 ";
  std::string understood_m = " ";
  for (int number = 0; number < 1000; ++number) {
    const std::string name = fmt::format("{} ", number);
    understood_m += refused_m.find(" " + name) == std::string::npos ? name : "";
  }
  for (int tenths = 0; tenths < 11000; ++tenths) {
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
  for (const char letter : std::string("ELOQ")) {
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
  EXPECT_EQ(error_of("G0 X1 T1.5"), "line 1:7: T1.5: expected a whole number, zero or more");
  EXPECT_EQ(error_of("T-1"), "line 1:1: T-1: expected a whole number, zero or more");
  EXPECT_EQ(error_of("S-1"), "line 1:1: S-1: expected zero or more");
  EXPECT_EQ(error_of("G64 P-0.1"), "line 1:5: P-0.1: expected zero or more");
  EXPECT_EQ(error_of("G64 P0.0000001"),
            "line 1:5: P1e-07: a path tolerance finer than coordinates can tell: expected 0, or at "
            "least 1e-06");
}

TEST(Refused, ArcWordsWithoutAnArc) {
  EXPECT_EQ(error_of("G0 X1 I1"), "line 1:7: an arc's I, J, K or R needs G02 or G03 in force");
  EXPECT_EQ(error_of("G1 F1 X1 R1"), "line 1:10: an arc's I, J, K or R needs G02 or G03 in force");
}

}  // namespace refused_test
}  // namespace twin::gcode
