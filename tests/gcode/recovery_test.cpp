#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gcode/reader.hpp"

namespace twin::gcode {
namespace recovery_test {

using testing::ElementsAre;

/// The lines of all errors of a program.
std::vector<int> lines_of_errors(const std::string& text, const ReaderOptions& options = {}) {
  Reader reader = Reader::from_text(text, "", options);
  std::vector<int> lines;
  while (lines.size() < 20) {
    const auto block = reader.next();
    if (!block) {
      lines.push_back(block.error().line);
      if (!reader.resume()) {
        return lines;
      }
    } else if (!*block) {
      return lines;
    }
  }
  return lines;
}

TEST(Recovery, ArcBehindAnErrorBeginsWhereTheErrorsLineLeads) {
  EXPECT_THAT(lines_of_errors("G0 X0 Y0 F100\nG1 X10 Y0 W5\nG2 X20 Y0 I5 J0\n"), ElementsAre(2));
  EXPECT_THAT(lines_of_errors("G0 X0 Y0 F100\nG2 X10 Y0\nG2 X20 Y0 I5 J0\n"), ElementsAre(2));
  EXPECT_THAT(lines_of_errors("G0 X0 Y0 F100\nG1 X1..0 Y0\nG2 X20 Y0 I5 J0\n"), ElementsAre(2));
  EXPECT_THAT(lines_of_errors("G0 F100\nG1 X1..0\nX0 Y0\nG2 X20 Y0 I5 J0\n"), ElementsAre(2, 4));
}

TEST(Recovery, WhatLacksIsToldOnce) {
  EXPECT_THAT(lines_of_errors("G0 X1\nG1 X2\nX3\nX4\n"), ElementsAre(2));
  EXPECT_THAT(lines_of_errors("X1\nX2\nX3\n"), ElementsAre(1));
  EXPECT_THAT(lines_of_errors("G0 X#<a>\nX#<a>\nX#<b>\n"), ElementsAre(1, 3));
  EXPECT_THAT(lines_of_errors("#<a>=[1/0]\nG0 X#<a>\n"), ElementsAre(1));
}

TEST(Recovery, NurbsWithAnErrorIsOneError) {
  EXPECT_THAT(lines_of_errors("G0 X0 Y0 F100\nG5.2 X1 Y1 P1 L3\nX2 Y2 Q1\nX3 Y1 P1\nX4 Y5 P1\n"
                              "G5.3\nG1 X9\nG2 X8\n"),
              ElementsAre(3, 8));
  EXPECT_THAT(lines_of_errors("G0 X0 Y0 F100\nG6.2 P3 K0\nK0 X1 Y1 I4\nK1 X2 Y2\nG6.2 K1\nG6.2 K1\n"
                              "G1 X9\nG2 X8\n"),
              ElementsAre(3, 8));
}

TEST(Recovery, EndOfANurbsThatAnErrorHasLeftOutIsAnError) {
  EXPECT_THAT(lines_of_errors("G0 X0 Y0 F100\nG5.2 P1\nX Y1\nG21\nG5.3\nG1 X9\n"),
              ElementsAre(3, 5));
}

TEST(Recovery, GougeEndsTheCompensation) {
  EXPECT_THAT(lines_of_errors("G0 X0 Y0 F100\nG41.1 D4\nG1 X10\nX20\nY1\nX30\nG40\nX40\n").size(),
              1U);
}

TEST(Recovery, LoopWithAnErrorEnds) {
  EXPECT_LE(lines_of_errors("o1 while [#<a> LT 3]\nG0 X1\no1 endwhile\nX2 W1\n").size(), 20U);
}

}  // namespace recovery_test
}  // namespace twin::gcode
