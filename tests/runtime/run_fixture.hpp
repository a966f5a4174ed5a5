#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "runtime/run.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::runtime {

/// Runs a small program on a machine, in a folder of its own.
class RunProgram : public ::testing::Test {
 protected:
  RunProgram() {
    auto read = config::read_machine_file(TWIN_SOURCE_DIR "/mjcf/xy_table.toml");
    EXPECT_TRUE(read);
    request.machine = *read;
    request.directory = folder / "out";
    request.program =
        test::text_of(folder.put("small.nc", "G01 X10 F3000\nG03 X20 Y10 R10\nG01 Y20\nX0 Y0\n"));
  }
  Expected<RunResult> run(hal::Machine* machine) {
    request.hal = machine;
    return run_program(request);
  }
  bool has(const char* name) const { return std::filesystem::exists(folder / "out" / name); }

  test::TempFolder folder;
  RunRequest request;
};

}  // namespace twin::runtime
