#include <csignal>
#include <thread>

#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"

// The whole command, on the simulated table.
namespace twin::studies::reproduce {
namespace command_test {

using ::testing::HasSubstr;

class ReproduceCommand : public test::CliTest {
 protected:
  std::string text(const std::string& name) const { return test::content(folder / name); }
};

TEST_F(ReproduceCommand, WritesTheSameTablesEveryTime) {
  const auto first = twin({"reproduce", "--repeats", "1", "--no-plots", "--out", "first"});
  ASSERT_EQ(first.status, 0) << first.err;
  for (const char* const words :
       {"Table 1", "Table 3", "Table 5: dolphin", "Fast Bezier 3,000", "first/index.html"}) {
    EXPECT_THAT(first.out, HasSubstr(words));
  }
  const auto second =
      twin({"reproduce", "--repeats", "1", "--no-plots", "--quiet", "--out", "second"});
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(second.out, "");
  for (const char* const name : {"/tables.csv", "/tables.md", "/reproduce.json", "/index.html"}) {
    EXPECT_FALSE(text(std::string("first") + name).empty()) << name;
    EXPECT_EQ(text(std::string("first") + name), text(std::string("second") + name)) << name;
  }
}

TEST_F(ReproduceCommand, InterruptLeavesNothing) {
  test::Child child({"reproduce", "--out", "out"}, {folder.path(), {}});
  for (int i = 0; i < 500 && !exists("out"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  child.signal(SIGINT);
  const auto result = child.wait();
  EXPECT_EQ(result.status, 130);
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "out"));
}

TEST_F(ReproduceCommand, BadInputIsOneLine) {
  expect_refusal(twin({"reproduce", "--machine", "none.toml", "--out", "out"}), 1, "none.toml");
  expect_refusal(twin({"reproduce", "--out", "ok.nc"}), 1, "ok.nc: cannot make this folder");
  expect_refusal(twin({"reproduce", "--set", "limits.jerkk=1", "--out", "out"}), 2, "jerkk");
  expect_refusal(twin({"reproduce", "--repeats", "1001"}), 2, "--repeats");
  EXPECT_TRUE(!exists("out") || std::filesystem::is_empty(folder / "out"));
}

}  // namespace command_test
}  // namespace twin::studies::reproduce
