#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "program.hpp"
#include "tests/support/files.hpp"

namespace twin::gcode {
namespace golden_test {

namespace fs = std::filesystem;

const fs::path kGolden = fs::path(TWIN_SOURCE_DIR) / "tests" / "golden" / "gcode";

std::string content_of(const fs::path& path) {
  EXPECT_TRUE(fs::is_regular_file(path)) << path;
  return test::content(path);
}

std::vector<fs::path> programs_in(const fs::path& folder) {
  std::vector<fs::path> programs;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".nc") {
      programs.push_back(entry.path());
    }
  }
  std::sort(programs.begin(), programs.end());
  return programs;
}

std::string result_of(const fs::path& path) {
  auto reader = Reader::open(path.string());
  if (!reader) {
    return to_string(reader.error()) + "\n";
  }
  auto blocks = read_rest(*reader);
  if (!blocks) {
    Error error = blocks.error();
    error.file = path.filename().string();
    return to_string(error) + "\n";
  }
  return to_text(*blocks);
}

TEST(Golden, ProgramsGiveTheirBlocks) {
  const auto programs = programs_in(kGolden);
  ASSERT_FALSE(programs.empty());
  for (const fs::path& program : programs) {
    EXPECT_EQ(result_of(program), content_of(fs::path(program).replace_extension(".txt")))
        << program;
  }
}

TEST(Golden, BadProgramsGetTheirMessage) {
  const auto programs = programs_in(kGolden / "bad");
  ASSERT_FALSE(programs.empty());
  for (const fs::path& program : programs) {
    EXPECT_EQ(result_of(program), content_of(fs::path(program).replace_extension(".err")))
        << program;
  }
}

}  // namespace golden_test
}  // namespace twin::gcode
