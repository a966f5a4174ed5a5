#include "gcode/interpreter/tool_table.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "program.hpp"

namespace twin::gcode {
namespace tool_table_test {

std::string fault_of(const std::string& text) {
  const auto table = ToolTable::from_text(text, "tools.tbl");
  return table ? "" : to_string(table.error());
}

TEST(ToolTable, LinesOfToolsWithRemarks) {
  const auto table = ToolTable::from_text(
      "; head\nT1 P17 X0.5 Y-1 Z+50.25 A0 D6 I0 J0 Q0 ; 6 mm\n\n  t20 p2 z.5\r\nT3 P1\n", "");
  ASSERT_TRUE(table);
  EXPECT_EQ(table->find(1)->offset, Vec3(0.5, -1.0, 50.25));
  EXPECT_EQ(table->find(1)->diameter, 6.0);
  EXPECT_EQ(table->find(20)->offset.z(), 0.5);
  EXPECT_EQ(table->find(3)->diameter, 0.0);
  EXPECT_EQ(table->find(2), nullptr);
}

TEST(ToolTable, FaultsHaveTheirPlace) {
  EXPECT_EQ(
      fault_of("T1 P1\nT2 ZZ5\n"),
      "tools.tbl:2:4: 'ZZ5': expected one of T P X Y Z A B C U V W D I J Q and its number, as "
      "in T1 P1 Z50 D6");
  EXPECT_EQ(fault_of("P1 Z5\n"), "tools.tbl:1: no T word: expected the number of the tool");
  EXPECT_EQ(fault_of("T1\nT1\n"), "tools.tbl:2: tool 1 is there twice: expected it once");
  EXPECT_EQ(fault_of("T1.5\n"), "tools.tbl:1:1: T1.5: expected the number of a tool");
  EXPECT_EQ(fault_of("T1 D1000000\n"), "tools.tbl:1:4: D1000000: expected at most 100000 mm");
}

ReaderOptions with_tools(const std::string& text) {
  ReaderOptions options;
  options.tools = std::make_shared<const ToolTable>(*ToolTable::from_text(text, ""));
  return options;
}

TEST(ToolTable, LengthAndDiameterReachTheMoves) {
  const ReaderOptions options = with_tools("T4 Z12.5 D6\n");
  const auto blocks = blocks_of("T4 M6\nG43 H4 G0 Z1\nG41 D4 G1 X10 Y0 F60\nX20\nM2\n", options);
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_EQ(blocks[1].end, Vec3(0.0, 0.0, 13.5));
  EXPECT_NEAR((blocks[3].end - Vec3(20.0, 3.0, 13.5)).norm(), 0.0, 1e-12);
}

TEST(ToolTable, AMissingToolIsNoted) {
  Reader reader = Reader::from_text("G43 H9 G0 Z1\nM2\n", "a.nc");
  ASSERT_TRUE(read_rest(reader));
  ASSERT_EQ(reader.notes().all().size(), 1U);
  EXPECT_EQ(reader.notes().all()[0].text,
            "tool 9 is not in the tool table: its length is taken as 0");
  EXPECT_EQ(reader.notes().all()[0].first_line, 1);
}

TEST(ToolTable, AFileThatIsNotThereEndsTheReading) {
  ReaderOptions options;
  options.tool_table = "no/such/file.tbl";
  EXPECT_EQ(error_of("G0 X1\n", options).substr(0, 45),
            "no/such/file.tbl: cannot open the tool table:");
}

}  // namespace tool_table_test
}  // namespace twin::gcode
