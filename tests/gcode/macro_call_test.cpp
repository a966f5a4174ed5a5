#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "program.hpp"

namespace twin::gcode {
namespace macro_call_test {

using testing::HasSubstr;

const ReaderOptions kFanuc = [] {
  ReaderOptions options;
  options.dialect = Dialect::kFanuc;
  return options;
}();

std::string ends_of(const std::string& text) {
  std::string ends;
  for (const Block& block : blocks_of(text, kFanuc)) {
    ends += fmt::format("{:.6g},{:.6g} ", block.end.x(), block.end.y());
  }
  return ends;
}

TEST(MacroCall, LettersBehindG65AreArguments) {
  EXPECT_EQ(ends_of("G65 P9010 A1 B2 I4 X24 Y25\nM30\nO9010\nG0 X#1 Y#2\nX#4\nX#24 Y#25\nM99\n"),
            "1,2 4,2 24,25 ");
  EXPECT_EQ(ends_of("#1=5\nG65 P9010 A1\nG0 Y#1\nM30\nO9010\n#1=[#1+1]\nG0 X#1\nM99\n"),
            "2,0 2,5 ");
  EXPECT_EQ(ends_of("#101=0\nG65 P9010 L3 A2\nM30\nO9010\n#101=#101+#1\n#1=7\nG0 X#101\nM99\n"),
            "2,0 4,0 6,0 ");
}

TEST(MacroCall, G66CallsBehindEveryMove) {
  EXPECT_EQ(ends_of("G66 P9010 A7\nG0 X1\nG90\nX2\nG67\nX3\nM30\nO9010\nG0 Y#1\nY0\nM99\n"),
            "1,0 1,7 1,0 2,0 2,7 2,0 3,0 ");
}

TEST(MacroCall, WhatWasNeverSetIsNull) {
  EXPECT_EQ(ends_of("G65 P9010 X5\nM30\nO9010\nG0 X#24 Y#25\nIF [#25 EQ #0] GOTO 5\nX9\n"
                    "N5 IF [#25 EQ 0] THEN #24=8\nX[#24+#25] Y1\nIF[#24NE#0]THEN#2=3\nY#2\nM99\n"),
            "5,0 5,1 5,3 ");
  EXPECT_EQ(ends_of("G0 X1 Y1\n#1=2\nX#1\n#1=#0\nX#1 Y3\n"), "1,1 2,1 2,3 ");
}

TEST(MacroCall, NullIsOfFanucAlone) {
  EXPECT_EQ(blocks_of("G0 X1\nX#7 Y1")[1].end.x(), 0.0);
  EXPECT_THAT(error_of("G0 X#0"), HasSubstr("#0: expected a parameter from #1"));
}

TEST(MacroCall, BadCallsAreRefusedByName) {
  ReaderOptions linuxcnc;
  linuxcnc.dialect = Dialect::kLinuxCnc;
  EXPECT_THAT(error_of("G65 P1", linuxcnc), HasSubstr("expected --dialect fanuc"));
  EXPECT_THAT(error_of("G65 A1", kFanuc), HasSubstr("G65 names no macro: expected P"));
  EXPECT_THAT(error_of("G65 P9010 A1 A2", kFanuc), HasSubstr("A appears twice behind G65"));
  EXPECT_THAT(error_of("G0 X1\nG65 P9010", kFanuc),
              HasSubstr("line 2:5: there is no O9010 in the program, and no file 9010.ngc or "));
  EXPECT_THAT(error_of("#0=1", kFanuc), HasSubstr("#0 is always null"));
  EXPECT_THAT(error_of("G65 P1\nO1\nG65 P1\nM99", kFanuc), HasSubstr("calls within calls"));
}

}  // namespace macro_call_test
}  // namespace twin::gcode
