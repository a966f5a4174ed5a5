#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "programs.hpp"

namespace twin::studies::convert {
namespace refusal_test {

using testing::HasSubstr;

std::string refusal(const std::string& text, const std::string& dialect) {
  const auto conversion = test::convert_text(text, dialect);
  return conversion ? "converted" : to_string(conversion.error());
}

/// Short blocks of a helix, which are fitted.
std::string rising_curve() {
  std::string text = "G1 F600 X30\n(a comment)\n";
  for (int i = 1; i <= 30; ++i) {
    text += "X" + std::to_string(30.0 * std::cos(0.01 * i)) + " Y" +
            std::to_string(30.0 * std::sin(0.01 * i)) + " Z" + std::to_string(0.01 * i) + "\n";
  }
  return text + "M30\n";
}

TEST(Refusal, CurveThatLeavesThePlaneOfG52NamesItsLine) {
  EXPECT_EQ(refusal(rising_curve(), "g5.2"),
            "line 3: the curve that begins here leaves the XY plane, which G5.2 cannot write: "
            "expected --to g6.2 or bspline");
  EXPECT_EQ(refusal(rising_curve(), "g6.2"), "converted");
  EXPECT_EQ(refusal(rising_curve(), "bspline"), "converted");
}

TEST(Refusal, DegreesADialectDoesNotHave) {
  const std::string line = "F600 G0 X0\nG06.2 P2 K0\nK0 X1\nK1\nK1\nM30\n";
  EXPECT_THAT(refusal(line, "g5.2"), HasSubstr("line 2: a NURBS of degree 1 cannot be written"));
  EXPECT_THAT(refusal(line, "bspline"), HasSubstr("line 2: a NURBS of degree 1 cannot be written"));
  EXPECT_EQ(refusal(line, "fanuc"), "converted");
  const std::string quartic = "F600 G0 X0\nG05.2 P1 L5\nX1 Y1\nX2 Y0\nX3 Y1\nX4 Y0\nG05.3\nM30\n";
  EXPECT_THAT(refusal(quartic, "fanuc"),
              HasSubstr("line 2: a NURBS of degree 4 cannot be written"));
  EXPECT_THAT(refusal(quartic, "bspline"), HasSubstr("it has degree 2 or 3"));
  EXPECT_EQ(refusal(quartic, "g5.2"), "converted");
  EXPECT_EQ(refusal(quartic, "g6.2"), "converted");
}

TEST(Refusal, WeightsThatSiemensDoesNotHave) {
  const std::string heavy = "F600 G0 X0\nG05.2 P1 L4\nX1 Y1 P3.5\nX2 Y0\nX3 Y1\nG05.3\nM30\n";
  EXPECT_THAT(refusal(heavy, "bspline"), HasSubstr("line 2: a weight 3.5 times"));
  EXPECT_EQ(refusal(heavy, "g6.2"), "converted");
}

TEST(Refusal, ErrorsOfTheProgramArePassedOn) {
  EXPECT_EQ(refusal("G1 X1\n", "g6.2"),
            "part.nc:1:4: G01 has no feedrate: expected an F word on this line or before it");
  EXPECT_THAT(refusal("F600 G0 X1\nG05.2 P1\nX2 Y1\nX3 Y0\n", "g6.2"),
              HasSubstr("part.nc:2:1: the G05.2 that begins here has no G05.3"));
}

TEST(Refusal, UnknownDialectsAreNone) {
  EXPECT_EQ(make_dialect("g5.1"), nullptr);
  EXPECT_EQ(make_dialect(""), nullptr);
  for (const std::string& name : dialect_names()) {
    ASSERT_NE(make_dialect(name), nullptr);
    EXPECT_EQ(make_dialect(name)->name(), name);
  }
}

}  // namespace refusal_test
}  // namespace twin::studies::convert
