#include <unistd.h>

#include "tests/support/cli_fixture.hpp"

// Results that cannot be written.
namespace twin::cli {
namespace bad_output_test {

class BadOutput : public test::CliTest {
 protected:
  test::ChildResult run_into(const std::string& out) const {
    return twin({"run", "ok.nc", "--out", out, "--no-plots", "--quiet"});
  }
};

TEST_F(BadOutput, FolderIsAFile) {
  expect_refusal(run_into("ok.nc"), 1, "ok.nc: cannot make this folder");
  expect_refusal(run_into("ok.nc/below"), 1, "ok.nc/below: cannot make this folder");
}

TEST_F(BadOutput, FolderCannotBeMade) {
  expect_refusal(run_into("/proc/none"), 1, "/proc/none: cannot make this folder");
}

TEST_F(BadOutput, FolderIsWriteProtected) {
  if (geteuid() == 0) {
    GTEST_SKIP() << "root may write everywhere";
  }
  std::filesystem::create_directories(folder / "out/plots");
  std::filesystem::permissions(
      folder / "out", std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  expect_refusal(run_into("out"), 1, "Permission denied");
}

TEST_F(BadOutput, DiskIsFull) {
  std::filesystem::create_directories(folder / "out");
  std::filesystem::create_symlink("/dev/full", folder / "out/trace.partial.csv");
  expect_refusal(run_into("out"), 1, "out/trace.csv: cannot write: No space left on device");
}

TEST_F(BadOutput, SummaryCannotBeWritten) {
  std::filesystem::create_directories(folder / "out/summary.json.tmp");
  const auto result = run_into("out");
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "twin: out/summary.json.tmp: cannot open for writing: Is a directory\n");
  EXPECT_FALSE(exists("out/summary.json"));
}

TEST_F(BadOutput, DiskFillsUpWhileTheMachineMoves) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the thread sanitizer's own files do not survive a limit of file size";
#endif
  folder.put("long.nc", "G01 X150 F1500\nX-150\nX0\n");
  const auto result = test::run_twin({"run", "long.nc", "--out", "out", "--no-plots", "--quiet"},
                                     {folder.path(), 200000});
  expect_refusal(result, 1, "out/trace.csv: cannot write: ");
  EXPECT_LE(std::filesystem::file_size(folder / "out/trace.partial.csv"), 200000U);
}

TEST_F(BadOutput, OlderResultsStayWholeWhenARunFails) {
  ASSERT_EQ(run_into("out").status, 0);
  const auto before = std::filesystem::file_size(folder / "out/trace.csv");
  std::filesystem::create_directory(folder / "out/trace.partial.csv");
  const auto result = run_into("out");
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(std::filesystem::file_size(folder / "out/trace.csv"), before);
}

}  // namespace bad_output_test
}  // namespace twin::cli
