#include "runtime/program_check.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::runtime {
namespace program_check_test {

using ::testing::HasSubstr;

class ProgramCheck : public ::testing::Test {
 protected:
  Expected<ProgramFigures> check(const std::string& text) {
    return check_program(test::text_of(folder.put("part.nc", text)), {}, limits);
  }
  /// The message of a program that must be refused.
  std::string refusal(const std::string& text) {
    const auto checked = check(text);
    return checked ? "accepted" : to_string(checked.error());
  }

  test::TempFolder folder;
  Limits limits;  // X, Y +-200 mm, Z +-60 mm
};

TEST_F(ProgramCheck, CountsBlocksLinesAndLengthOfARectangleWithARoundEnd) {
  const auto figures =
      check("G21\nG01 F600 X30\nY40\nG03 X30 Y60 J10\nG04 P1\nG00 X0 Y0 Z5\nM30\n");
  ASSERT_TRUE(figures) << to_string(figures.error());
  EXPECT_EQ(figures->blocks, 4);
  EXPECT_EQ(figures->lines, 7);
  const double last = std::sqrt(30.0 * 30.0 + 60.0 * 60.0 + 5.0 * 5.0);
  EXPECT_NEAR(figures->length, 30.0 + 40.0 + 10.0 * std::numbers::pi + last, 1e-9);
  EXPECT_TRUE(figures->box_min.isApprox(Vec3(0.0, 0.0, 0.0)));
  EXPECT_TRUE(figures->box_max.isApprox(Vec3(40.0, 60.0, 5.0)));
}

TEST_F(ProgramCheck, NamesAxisPlaceLimitAndLineOfALineThatLeavesTheTravel) {
  const std::string message = refusal("G01 F600 X10\nY199\nY200.5\nX300\n");
  EXPECT_THAT(message, HasSubstr("part.nc:3: "));
  EXPECT_THAT(message, HasSubstr("axis Y"));
  EXPECT_THAT(message, HasSubstr("200.5000 mm"));
  EXPECT_THAT(message, HasSubstr("travel ends at 200 mm"));
}

TEST_F(ProgramCheck, NamesTheLowerEndOfTravel) {
  const std::string message = refusal("G00 X-200.001\n");
  EXPECT_THAT(message, HasSubstr("axis X would go to -200.0010 mm"));
  EXPECT_THAT(message, HasSubstr("ends at -200 mm"));
}

TEST_F(ProgramCheck, HoldsTheTravelOfZ) {
  EXPECT_THAT(refusal("G00 Z60.1\n"), HasSubstr("axis Z would go to 60.1000 mm"));
  EXPECT_THAT(refusal("G00 Z-61\n"), HasSubstr("axis Z would go to -61.0000 mm"));
}

TEST_F(ProgramCheck, AcceptsTheVeryEndsOfTravel) {
  EXPECT_EQ(refusal("G00 X200 Y-200 Z60\nX-200 Y200 Z-60\n"), "accepted");
}

TEST_F(ProgramCheck, SeesAnArcThatBulgesOutBetweenEndsInsideTheTravel) {
  const std::string start = "G00 X190 Y-20\n";
  EXPECT_THAT(refusal(start + "G03 F600 X190 Y20 J20\n"), HasSubstr("axis X would go to 210.0000"));
  EXPECT_EQ(refusal(start + "G02 F600 X190 Y20 J20\n"), "accepted");
}

TEST_F(ProgramCheck, SeesAnArcThatBulgesOutInThePlaneOfZ) {
  // Half a circle of 30 mm about X0 Z40: over its top at Z70, or under it. About +Y, Z turns to X.
  const std::string start = "G18\nG00 X-30 Z40\n";
  EXPECT_THAT(refusal(start + "G03 F600 X30 Z40 I30\n"),
              HasSubstr("axis Z would go to 70.0000 mm"));
  EXPECT_EQ(refusal(start + "G02 F600 X30 Z40 I30\n"), "accepted");
}

TEST_F(ProgramCheck, SeesANurbsThatBulgesOutBetweenEndsInsideTheTravel) {
  // Half of it is at Y = 0.75 * 270.
  EXPECT_THAT(refusal("F600 G0 X0\nG05.2 P1 L4\nX0 Y270 P1\nX10 Y270 P1\nX10 Y0 P1\nG05.3\nM30\n"),
              HasSubstr("part.nc:2: axis Y would go to 202.5000 mm"));
  const auto inside =
      check("F600 G0 X0\nG05.2 P1 L4\nX0 Y260 P1\nX10 Y260 P1\nX10 Y0 P1\nG05.3\nM30\n");
  ASSERT_TRUE(inside) << to_string(inside.error());
  EXPECT_NEAR(inside->box_max.y(), 195.0, 1e-9);
}

TEST_F(ProgramCheck, PassesOnTheReadersErrors) {
  EXPECT_THAT(refusal("G01 X1\n"), HasSubstr("part.nc:1"));
}

// Truth: points of the circle by cosine and sine, close together.
TEST_F(ProgramCheck, BoxOfRandomArcsIsThatOfTheirPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Vec2 centre(40.0 * unit(random) - 20.0, 40.0 * unit(random) - 20.0);
    const double radius = 1.0 + 40.0 * unit(random);
    const double first = 2.0 * std::numbers::pi * unit(random);
    const double sweep = (0.02 + 1.9 * unit(random)) * std::numbers::pi;
    const double sense = i % 2 == 0 ? 1.0 : -1.0;
    const auto at = [&](double f) -> Vec2 {
      const double angle = first + sense * f * sweep;
      return centre + radius * Vec2(std::cos(angle), std::sin(angle));
    };
    const Vec2 offset = centre - at(0.0);
    const auto figures = check(fmt::format(
        "G00 X{:.7f} Y{:.7f}\n{} F600 X{:.7f} Y{:.7f} I{:.7f} J{:.7f}\n", at(0.0).x(), at(0.0).y(),
        sense > 0.0 ? "G03" : "G02", at(1.0).x(), at(1.0).y(), offset.x(), offset.y()));
    ASSERT_TRUE(figures) << to_string(figures.error());
    Vec2 low = Vec2::Zero();  // the start of the program
    Vec2 high = Vec2::Zero();
    for (int k = 0; k <= 20000; ++k) {
      low = low.cwiseMin(at(k / 20000.0));
      high = high.cwiseMax(at(k / 20000.0));
    }
    EXPECT_LT((figures->box_min.head<2>() - low).norm(), 1e-5) << "arc " << i;
    EXPECT_LT((figures->box_max.head<2>() - high).norm(), 1e-5) << "arc " << i;
  }
}

}  // namespace program_check_test
}  // namespace twin::runtime
