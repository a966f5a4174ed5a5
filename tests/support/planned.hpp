#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "gcode/reader.hpp"
#include "runtime/planning.hpp"

namespace twin::test {

/// All planned segments of a program's text.
inline std::vector<feedrate::PlannedSegment> plan_text(const std::string& text,
                                                       const config::MachineFile& machine = {}) {
  std::vector<feedrate::PlannedSegment> planned;
  auto reader = gcode::Reader::from_text(text, "text");
  const auto figures = runtime::plan_program(reader, machine, [&](auto&& segment) {
    planned.push_back(std::move(segment));
    return true;
  });
  EXPECT_TRUE(figures) << (figures ? "" : to_string(figures.error()));
  return planned;
}

}  // namespace twin::test
