#include <gtest/gtest.h>

#include "nc_programs/generate/programs.hpp"
#include "tests/support/nc_file.hpp"

namespace twin::programs {
namespace regenerate_test {

TEST(Generator, WritesTheFilesThatAreKept) {
  const std::vector<ProgramFile> made = all_programs();
  ASSERT_EQ(made.size(), 11U);
  for (const ProgramFile& file : made) {
    EXPECT_TRUE(file.text == test::read_file(file.name))
        << file.name << " differs; run twin_generate_programs nc_programs";
  }
}

}  // namespace regenerate_test
}  // namespace twin::programs
