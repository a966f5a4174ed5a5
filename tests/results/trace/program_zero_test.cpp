#include "results/trace/program_zero.hpp"

#include <gtest/gtest.h>

#include "results/metrics/summary.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::results {
namespace program_zero_test {

TEST(ProgramZero, HoldsFromItsInstantOn) {
  ProgramZero zero;
  zero.add(0.0, 0.0);
  EXPECT_TRUE(zero.changes().empty());
  zero.add(1.0, 12.5);
  zero.add(2.0, 12.5);
  zero.add(3.0, -4.0);
  EXPECT_EQ(zero.changes().size(), 2U);
  EXPECT_EQ(zero.at(0.999), 0.0);
  EXPECT_EQ(zero.at(1.0), 12.5);
  EXPECT_EQ(zero.at(2.999), 12.5);
  EXPECT_EQ(zero.at(1e9), -4.0);
}

TEST(ProgramZero, StandsInTheSummaryBesideTheTrace) {
  const test::TempFolder folder;
  Summary summary;
  summary.program_zero.add(0.0, 12.5);
  summary.program_zero.add(7.25, 0.0);
  test::put(folder.path() / "summary.json", to_json(summary));
  const ProgramZero zero = ProgramZero::beside(folder.path() / "trace.csv");
  EXPECT_EQ(zero.at(7.2), 12.5);
  EXPECT_EQ(zero.at(7.25), 0.0);
  EXPECT_TRUE(ProgramZero::beside(folder.path() / "elsewhere" / "trace.csv").changes().empty());
}

TEST(ProgramZero, IsZeroWhereASummarySaysNothingOrNonsense) {
  EXPECT_EQ(to_json(Summary{}).find("program_zero_mm"), std::string::npos);
  for (const char* text : {"", "[]", "{}", R"({"program_zero_mm": 5})",
                           R"({"program_zero_mm": [5, [1], ["a", "b"]]})"}) {
    EXPECT_TRUE(ProgramZero::of_summary(text).changes().empty()) << text;
  }
}

}  // namespace program_zero_test
}  // namespace twin::results
