#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "gcode/interpreter/tool_table.hpp"
#include "gcode/reader.hpp"
#include "results/metrics/block_distance.hpp"

// read_blocks [--tools FILE] PROGRAM...: the blocks of programs, as tests that ask a peer need them.
//
//   LINE KIND X Y Z LENGTH   for each block: where it ends and how long it is [mm]; a rest has its
//                            time [s] in place of the length
//   end                      or: error TEXT
//
// KIND is rapid, linear, arc, nurbs or rest.

namespace {

using twin::gcode::Block;
using twin::gcode::Motion;

void print(const Block& block) {
  const char* const kinds[] = {"rapid", "linear", "arc", "nurbs", "rest"};
  const double size = block.motion == Motion::kDwell
                          ? block.dwell
                          : twin::results::block_length(block, twin::results::View::kSpace);
  fmt::print("{} {} {:.9f} {:.9f} {:.9f} {:.9f}\n", block.line,
             kinds[static_cast<int>(block.motion)], block.end.x(), block.end.y(), block.end.z(),
             size);
}

void print_program(const std::string& path, const twin::gcode::ReaderOptions& options) {
  auto reader = twin::gcode::Reader::open(path, options);
  if (!reader) {
    fmt::print("error {}\n", to_string(reader.error()));
    return;
  }
  for (;;) {
    const auto block = reader->next();
    if (!block) {
      fmt::print("error {}\n", to_string(block.error()));
      return;
    }
    if (!*block) {
      fmt::print("end\n");
      return;
    }
    print(**block);
  }
}

}  // namespace

int main(int count, char** arguments) {
  twin::gcode::ReaderOptions options;
  int first = 1;
  if (count > 2 && std::string(arguments[1]) == "--tools") {
    auto table = twin::gcode::ToolTable::read(arguments[2]);
    if (!table) {
      fmt::print(stderr, "{}\n", to_string(table.error()));
      return 1;
    }
    options.tools = std::make_shared<const twin::gcode::ToolTable>(*std::move(table));
    first = 3;
  }
  for (int i = first; i < count; ++i) {
    print_program(arguments[i], options);
  }
  return 0;
}
