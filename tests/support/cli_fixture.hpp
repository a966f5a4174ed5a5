#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/child.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::test {

/// Runs `twin` in a folder of its own that holds `ok.nc`, a small sound program.
class CliTest : public ::testing::Test {
 protected:
  CliTest() { folder.put("ok.nc", "G01 X5 F1200\nG03 X8 Y3 R3\nG01 X0 Y0\nM30\n"); }

  ChildResult twin(const std::vector<std::string>& arguments) const {
    return run_twin(arguments, {folder.path(), {}});
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder / name); }

  /// The one line that a refusal leaves, and no result that poses as whole.
  void expect_refusal(const ChildResult& result, int status, const std::string& text,
                      const std::string& out = "out") const {
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, ::testing::StartsWith("twin: "));
    EXPECT_THAT(result.err, ::testing::HasSubstr(text));
    EXPECT_FALSE(exists(out + "/trace.csv"));
    EXPECT_FALSE(exists(out + "/summary.json"));
  }

  TempFolder folder;
};

}  // namespace twin::test
