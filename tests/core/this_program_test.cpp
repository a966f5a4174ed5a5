#include "core/this_program.hpp"

#include <gtest/gtest.h>

#include <array>

namespace twin {
namespace this_program_test {

TEST(ShellQuoted, LeavesPlainWordsAsTheyAre) {
  const std::array words{"twin", "run", "a/b.nc", "--set", "limits.jerk=5e4"};
  EXPECT_EQ(shell_quoted(words), "twin run a/b.nc --set limits.jerk=5e4");
}

TEST(ShellQuoted, QuotesWhatAShellWouldTakeApartOrReplace) {
  const std::array words{"my program.nc", "it's", "", "$HOME", "a=[1, 2]"};
  EXPECT_EQ(shell_quoted(words), R"('my program.nc' 'it'\''s' '' '$HOME' 'a=[1, 2]')");
}

}  // namespace this_program_test
}  // namespace twin
