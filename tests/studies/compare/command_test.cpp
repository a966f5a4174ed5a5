#include <sstream>

#include "tests/support/cli_fixture.hpp"

// The command as a user calls it.
namespace twin::studies::compare {
namespace command_test {

using ::testing::HasSubstr;

class CompareCommand : public test::CliTest {};

TEST_F(CompareCommand, PrintsATableAndWritesItsFiles) {
  const auto result = twin({"compare", "ok.nc", "--no-plots", "--hal", "ideal", "--out", "out"});
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* const words :
       {"nurbs", "bezier", "linear", "machining time", "butterfly_nurbs.nc"}) {
    EXPECT_THAT(result.out, HasSubstr(words));
  }
  for (const char* const name : {"compare.csv", "compare.md", "compare.json", "fluctuation.csv"}) {
    EXPECT_TRUE(exists(std::string("out/") + name)) << name;
  }
  EXPECT_FALSE(exists("out/figures"));
}

TEST_F(CompareCommand, SeveralProgramsAreATableOfThePlanners) {
  folder.put("corner.nc", "G01 X20 F3000\nY20\nM30\n");
  const auto result = twin({"compare", "ok.nc", "corner.nc", "--out", "out"});
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* const words : {"ok ", "corner ", "paper", "certified", "kept"}) {
    EXPECT_THAT(result.out, HasSubstr(words));
  }
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 120U) << line;
  }
  for (const char* const name : {"planners.csv", "planners.md", "planners.json"}) {
    EXPECT_TRUE(exists(std::string("out/") + name)) << name;
  }
}

TEST_F(CompareCommand, BadInputIsOneLine) {
  expect_refusal(twin({"compare", "none.nc", "--out", "out"}), 1, "none.nc");
  folder.put("bad.nc", "G01 X5 F100\nG77 X1\n");
  expect_refusal(twin({"compare", "bad.nc", "--out", "out"}), 1, "bad.nc:2");
  expect_refusal(twin({"compare", "ok.nc", "bad.nc", "--out", "out"}), 1, "bad.nc, paper: ");
  expect_refusal(twin({"compare", "ok.nc", "--set", "limits.jerkk=1", "--out", "out"}), 2, "jerkk");
  expect_refusal(twin({"compare", "ok.nc", "--hal", "rig"}), 2, "--hal");
  expect_refusal(twin({"compare", "ok.nc", "--out", "ok.nc"}), 1, "ok.nc: cannot make this folder");
  EXPECT_TRUE(!exists("out") || std::filesystem::is_empty(folder / "out"));
}

}  // namespace command_test
}  // namespace twin::studies::compare
