#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/faults/fault_table.hpp"
#include "tests/support/files.hpp"

namespace twin::test {
namespace readme_test {

TEST(FaultTableInReadme, HasTheRowsThatAreTested) {
  const std::string readme = content(TWIN_SOURCE_DIR "/hal/README.md");
  for (const FaultRow& row : kFaultRows) {
    EXPECT_THAT(readme, ::testing::HasSubstr(to_markdown(row) + "\n"));
  }
}

}  // namespace readme_test
}  // namespace twin::test
