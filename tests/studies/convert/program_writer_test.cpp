#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "programs.hpp"

namespace twin::studies::convert {
namespace program_writer_test {

using testing::HasSubstr;

std::string body(const std::string& text, const std::string& dialect) {
  const auto conversion = test::convert_text(text, dialect);
  EXPECT_TRUE(conversion) << to_string(conversion.error());
  if (!conversion) {
    return {};
  }
  const auto begin = conversion->text.find("G94\n") + 4;
  return conversion->text.substr(begin);
}

TEST(ProgramWriter, LinesRapidsAndRests) {
  EXPECT_EQ(
      body("G0 X1 Y2 Z5\nG1 Z-1.5 F300\nX20 F600\nG4 P0.5\nG61 Y9\nG64 P0.02 X0\nM2\n", "g6.2"),
      "G64\nG00 X1 Y2 Z5\nG01 X1 Y2 Z-1.5 F300\nX20 Y2 F600\nG04 P0.5\nG61\nX20 Y9\n"
      "G64 P0.02\nX0 Y9\nM30\n");
}

TEST(ProgramWriter, SiemensAndFanucWordsOfTheirOwn) {
  const std::string program = "G0 X1\nG4 P0.5\nG61 G1 F60 X0\nG64 P0.1 X5\nM2\n";
  EXPECT_EQ(body(program, "bspline"),
            "G64\nG00 X1 Y0\nG4 F0.5\nG60\nG01 X0 Y0 F60\nG64 ; tolerance 0.1 mm\nX5 Y0\nM30\n");
  EXPECT_EQ(body(program, "fanuc"),
            "G64\nG00 X1 Y0\nG04 P500\nG61\nG01 X0 Y0 F60\nG64\nX5 Y0\nM30\n");
}

TEST(ProgramWriter, ArcsInAllPlanesComeBackAsTheyWere) {
  const std::string program =
      "F600 G0 X10 Y0 Z0\nG17 G2 X0 Y10 I-10 J0\nG3 X0 Y10 J-5 Z1\nG18 G2 X10 Z1 I5 K0\n"
      "G3 X12 Z3 R2\nG19 G2 Y20 Z3 J5 K0\nG3 Y22 Z5 R2\nM2\n";
  const auto before = test::blocks_of_text(program);
  const auto after = test::blocks_of_text(test::convert_text(program, "g5.2")->text);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto one = test::points_of(before[i], 0.1);
    const auto other = test::points_of(after[i], 0.1);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_LT((one[k] - other[k]).norm(), 5e-6) << "block " << i;
    }
  }
}

TEST(ProgramWriter, InchesAndIncrementsBecomeAbsoluteMillimetres) {
  EXPECT_EQ(body("G20 G91 G1 F10 X1\nX20 Y1\nM2\n", "g6.2"),
            "G64\nG01 X25.4 Y0 F254\nX533.4 Y25.4\nM30\n");
}

TEST(ProgramWriter, MovesBelowTheLastDigitVanish) {
  const auto conversion = test::convert_text("G1 F60 X20\nX20.0000001\nX40\nM2\n", "g6.2");
  ASSERT_TRUE(conversion);
  EXPECT_EQ(test::blocks_of_text(conversion->text).size(), 2U);
  ASSERT_EQ(conversion->groups.size(), 3U);
  EXPECT_EQ(conversion->groups[1].made, 0);
}

TEST(ProgramWriter, FeedrateStandsBeforeTheCurveAndMotionBehindIt) {
  std::string program = "F600 G0 X0\nG1\n";
  for (int i = 1; i <= 12; ++i) {
    program += "X" + std::to_string(0.3 * i) + " Y" + std::to_string(0.001 * i * i) + "\n";
  }
  const std::string text = body(program + "X50\nM2\n", "g5.2");
  EXPECT_THAT(text, HasSubstr("F600\nG05.2 P1 L4\n"));
  EXPECT_THAT(text, HasSubstr("G05.3\nG01 X50"));
}

}  // namespace program_writer_test
}  // namespace twin::studies::convert
