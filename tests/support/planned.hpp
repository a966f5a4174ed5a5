#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gcode/reader.hpp"
#include "runtime/inline_planning.hpp"
#include "runtime/planning.hpp"
#include "runtime/program_planner.hpp"

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

/// The blocks of a program's text.
inline runtime::BlockSource blocks_of(const std::string& text) {
  auto reader = std::make_shared<gcode::Reader>(gcode::Reader::from_text(text, "text"));
  return [reader] { return reader->next(); };
}

/// A program's text, planned when the motion asks for it.
struct InlinePlan {
  using Replans = runtime::ProgramPlanner::Replans;
  explicit InlinePlan(const std::string& text, const config::MachineFile& machine = {},
                      Replans replans = Replans::kNever, double percent = 100.0)
      : file(machine), planner(blocks_of(text), file, replans, percent), planning(planner, file) {}

  config::MachineFile file;
  runtime::ProgramPlanner planner;
  runtime::InlinePlanning planning;
};

}  // namespace twin::test
