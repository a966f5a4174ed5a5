#include <cmath>

#include "gcode/interpreter/tool_table.hpp"
#include "tests/fuzz/target.hpp"

namespace twin::fuzz {
namespace tools_target {

void run(Bytes bytes) {
  const auto table = gcode::ToolTable::from_text(text_of(bytes), "tools.tbl");
  if (!table) {
    promise(!table.error().message.empty(), "an error without a message");
    promise(table.error().line > 0, "an error without its line");
    return;
  }
  for (int number = 0; number < 100; ++number) {
    const gcode::Tool* const tool = table->find(number);
    promise(tool == nullptr ||
                (tool->offset.cwiseAbs().maxCoeff() <= gcode::ToolTable::kLargestNumber &&
                 std::abs(tool->diameter) <= gcode::ToolTable::kLargestNumber),
            "a number of a tool that is too large or none");
  }
}

}  // namespace tools_target

const Target kTools{"tools", tools_target::run};

}  // namespace twin::fuzz
