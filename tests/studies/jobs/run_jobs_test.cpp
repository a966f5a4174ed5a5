#include "studies/jobs/run_jobs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::jobs {
namespace run_jobs_test {

using ::testing::StartsWith;

Job make_job(const test::TempFolder& folder, const std::string& name, const std::string& program) {
  Job job;
  job.name = name;
  job.program = test::text_of(folder.put(name + ".nc", program));
  job.directory = folder / name;
  job.has_machine = false;
  return job;
}

/// A program whose error stands behind so many sound blocks.
std::string bad_program(int sound_blocks) {
  std::string text = "G01 F3000\n";
  for (int i = 0; i < sound_blocks; ++i) {
    text += i % 2 == 0 ? "X1\n" : "X0\n";
  }
  return text + "X9999\nM30\n";
}

TEST(RunJobs, ErrorIsThatOfTheFirstJobThatFailsHoweverLongItTakes) {
  const test::TempFolder folder;
  const std::array jobs{make_job(folder, "slow", bad_program(20000)),
                        make_job(folder, "quick", bad_program(0))};
  for (int i = 0; i < 10; ++i) {
    const auto result = run_jobs(jobs, {});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, StartsWith("slow: "));
  }
}

TEST(RunJobs, SummariesComeInTheOrderOfTheJobs) {
  const test::TempFolder folder;
  const std::array jobs{make_job(folder, "long", "G01 F3000 X20\nM30\n"),
                        make_job(folder, "short", "G01 F3000 X1\nM30\n")};
  const auto result = run_jobs(jobs, {});
  ASSERT_TRUE(result);
  EXPECT_NEAR((*result)[0].path_length, 20.0, 1e-9);
  EXPECT_NEAR((*result)[1].path_length, 1.0, 1e-9);
}

}  // namespace run_jobs_test
}  // namespace twin::studies::jobs
