#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "program.hpp"

namespace twin::gcode {
namespace flow_test {

using testing::HasSubstr;

/// The X of the ends of all blocks.
std::string ends_of(const std::string& text, const ReaderOptions& options = {}) {
  std::string ends;
  for (const Block& block : blocks_of(text, options)) {
    ends += fmt::format("{:.6g} ", block.end.x());
  }
  return ends;
}

TEST(Flow, IfTakesTheFirstTrueBranch) {
  const auto branch = [](int value) {
    return ends_of(
        fmt::format("G0 #1={}\no1 if [#1 EQ 1]\nX1\no1 elseif [#1 EQ 2]\nX2\n"
                    "o1 elseif [#1 EQ 2]\nX3\no1 else\nX4\no1 endif\nX9\n",
                    value));
  };
  EXPECT_EQ(branch(1), "1 9 ");
  EXPECT_EQ(branch(2), "2 9 ");
  EXPECT_EQ(branch(3), "4 9 ");
  EXPECT_EQ(ends_of("G0 X1\no1 if [0]\nX2\no1 endif\nX3"), "1 3 ");
}

TEST(Flow, LoopsRunAsOftenAsTheyShould) {
  EXPECT_EQ(ends_of("G0\n#1=1\no1 while [#1 LE 3]\nX#1\n#1=[#1+1]\no1 endwhile\nX9"), "1 2 3 9 ");
  EXPECT_EQ(ends_of("G0\n#1=1\no1 do\nX#1\n#1=[#1+1]\no1 while [#1 LT 1]\nX9"), "1 9 ");
  EXPECT_EQ(ends_of("G0 G91\no1 repeat [3]\nX1\no1 endrepeat\no1 repeat [0]\nX7\no1 endrepeat"),
            "1 2 3 ");
  EXPECT_EQ(ends_of("G0 G91\no1 repeat [2]\no2 repeat [2]\nX1\no2 endrepeat\no1 endrepeat"),
            "1 2 3 4 ");
}

TEST(Flow, BreakAndContinueLeaveTheirOwnLoop) {
  EXPECT_EQ(ends_of("G0\n#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\n"
                    "o3 if [#1 GT 3]\no1 break\no3 endif\nX#1\no1 endwhile\nX9"),
            "1 3 9 ");
  EXPECT_EQ(ends_of("G0 G91\no1 repeat [3]\no2 repeat [5]\nX1\no1 continue\no2 endrepeat\n"
                    "o1 endrepeat\n"),
            "1 2 3 ");
}

TEST(Flow, SubroutinesHaveVariablesOfTheirOwn) {
  EXPECT_EQ(ends_of("G0\no100 sub\nX#1 Y#2\n#1=7 #<a>=5 #<_b>=6 #40=8\no100 return [#1*2]\n"
                    "o100 endsub\n#1=3 #2=4 #<a>=1\no100 call [10]\nX#1\nX#<a>\nX#<_b>\nX#40\n"
                    "X#<_value>\n"),
            "10 3 1 6 8 14 ");
  EXPECT_EQ(ends_of("o<fac> sub\no1 if [#1 LE 1]\no<fac> return [1]\no1 endif\n"
                    "o<fac> call [#1-1]\no<fac> endsub [#1*#<_value>]\n"
                    "o<Fac> call [5]\nG0 X#<_value>"),
            "120 ");
  EXPECT_EQ(ends_of("o7 sub\nG0 X1\no7 endsub\n#1=3\no[#1+4] call\nG0 X2"), "1 2 ");
}

TEST(Flow, SubprogramsOfM98StandBehindTheProgram) {
  EXPECT_EQ(ends_of("O1 (main)\nG0 G91\nM98 P100 L2\nX10\nM30\nO100\nX1\nM98 P200\nM99\n"
                    "O200\nX5\nM99\n"),
            "1 6 7 12 22 ");
  EXPECT_EQ(ends_of("G0 G91\n#1=1\nM98 P0030100\nX#1\nM30\nO100\nX1\n#1=8\nM99\n"), "1 2 3 11 ");
  EXPECT_EQ(ends_of("G0 G91\nM98 P5\nN10 X10\nN20 X20\nM30\nO5\nX1\nM99 P20\n"), "1 21 ");
  EXPECT_EQ(ends_of("G0 X1\nM99\nX2"), "1 ");
}

TEST(Flow, FanucJumpsAndLoops) {
  EXPECT_EQ(ends_of("G0\n#1=1\nN10 IF [#1 GT 3] GOTO 20\nX#1\n#1=#1+0\n#1=[#1+1]\nGOTO 10\nN20 X9",
                    {.dialect = Dialect::kFanuc}),
            "1 2 3 9 ");
}

TEST(Flow, FanucWhileAndThen) {
  EXPECT_EQ(ends_of("O1\nG0\n#1=1\nWHILE[#1LE2]DO1\n#2=1\nWHILE [#2 LE 2] DO 2\nX[#1*10+#2]\n"
                    "#2=[#2+1]\nEND 2\n#1=[#1+1]\nEND1\nIF[#1 EQ 3]THEN #3=77\nX#3\nM30"),
            "11 12 21 22 77 ");
}

TEST(Flow, ProgramsWithoutEndAreStopped) {
  const std::string message = "the program does not end: 1000 lines were executed again";
  ReaderOptions options;
  options.most_lines = 1000;
  EXPECT_THAT(error_of("o1 while [1]\n#1=2\no1 endwhile", options), HasSubstr("line 2:1: "));
  EXPECT_THAT(error_of("o1 while [1]\n#1=2\no1 endwhile", options), HasSubstr(message));
  EXPECT_THAT(error_of("N1 GOTO 1", options), HasSubstr(message));
  EXPECT_THAT(error_of("o1 sub\no1 call\no1 endsub\no1 call", options),
              HasSubstr("line 2:2: 101 calls within calls: expected at most 100"));
}

TEST(Flow, WhatHasNoPartnerSaysWhatItLacks) {
  EXPECT_EQ(error_of("o1 if [1]\nG0 X1"), "line 1:2: o1 if: expected o1 endif");
  EXPECT_EQ(error_of("G0 X1\no1 endwhile"), "line 2:2: o1 endwhile: expected o1 while before it");
  EXPECT_EQ(error_of("o1 repeat [2]\nG0 X1"), "line 1:2: o1 repeat: expected o1 endrepeat");
  EXPECT_EQ(error_of("o1 sub\nG0 X1"), "line 1:2: o1 sub: expected o1 endsub");
  EXPECT_EQ(error_of("o1 break"), "line 1:2: o1 break: expected o1 while, do or repeat around it");
  EXPECT_EQ(
      error_of("o<none> call"),
      "line 1:2: there is no o<none> sub in the program, and no file none.ngc beside it or in "
      "a folder of --subprograms");
  EXPECT_EQ(error_of("o1 endsub"),
            "line 1:2: o1 endsub where o1 does not run: expected it between "
            "sub and endsub");
  EXPECT_EQ(error_of("GOTO 5"), "line 1:5: there is no line N5 to go to");
  EXPECT_EQ(
      error_of("o1 fi [1]"),
      "line 1:4: 'fi' behind an O-word: expected sub, endsub, call, return, if, elseif, else, "
      "endif, while, endwhile, do, repeat, endrepeat, break or continue");
  EXPECT_EQ(error_of("G0 X1\nO5\nX2\nM30"),
            "line 2:2: another program begins, O5: expected M02 or M30 before it");
  EXPECT_EQ(error_of("M98 P5\nM30\nO5\nG0 X1\n"), "line 4:1: the text ends in O5: expected M99");
}

TEST(Flow, ErrorsPointIntoTheLineWhateverStandsBeforeIt) {
  EXPECT_EQ(error_of("N5 o1 if [#<x>]\no1 endif"),
            "line 1:11: #<x> has no value: expected a line that sets it before this one");
  EXPECT_EQ(error_of("IF[1 EQ 1] THEN #1=2 Q-"),
            "line 1:22: Q has no number: expected one, found '-'");
}

}  // namespace flow_test
}  // namespace twin::gcode
