#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "gcode/program_text.hpp"

namespace twin::test {

/// The program in a file that a test has put there.
inline gcode::ProgramText text_of(const std::filesystem::path& file) {
  auto text = gcode::ProgramText::read(file);
  EXPECT_TRUE(text) << (text ? "" : to_string(text.error()));
  return text.value_or(gcode::ProgramText());
}

}  // namespace twin::test
