#include "studies/batch/batch.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "studies/batch/job_file.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::batch {
namespace batch_test {

using ::testing::HasSubstr;

constexpr const char* kProgram = "G21 G90\nG1 X3 Y1 F1200\nX0 Y4\nM30\n";

/// A folder with a program and the jobs of some settings of it.
class BatchTest : public ::testing::Test {
 protected:
  BatchTest() { std::ofstream(file()) << kProgram; }

  std::string file() const { return (folder / "short.nc").string(); }

  std::vector<PreparedJob> jobs(const std::vector<std::string>& settings,
                                JobMachine hal = JobMachine::kIdeal) {
    JobMaker maker;
    std::vector<PreparedJob> prepared;
    for (const std::string& setting : settings) {
      Job job;
      job.program = file();
      job.settings = {setting};
      job.hal = hal;
      prepared.push_back(*maker.prepare(job));
    }
    return prepared;
  }

  Store store() const { return *Store::open(folder / "store"); }

  test::TempFolder folder;
};

TEST_F(BatchTest, WhatTheStoreHoldsIsNotComputedAgain) {
  const auto some = jobs({"limits.jerk=20000", "limits.jerk=30000"});
  const auto more = jobs({"limits.jerk=20000", "limits.jerk=30000", "limits.jerk=40000"});
  const auto first = run_batch(some, store(), {});
  ASSERT_TRUE(first) << to_string(first.error());
  EXPECT_EQ(first->computed, 2U);
  const auto second = run_batch(more, store(), {});
  EXPECT_EQ(second->found, 2U);
  EXPECT_EQ(second->computed, 1U);
}

TEST_F(BatchTest, TheKeyFollowsFromWhatTheResultDependsOn) {
  const auto pair = jobs({"limits.jerk=20000", "limits.jerk_mm_per_s3=2e4"});
  EXPECT_EQ(pair[0].key, pair[1].key);
  EXPECT_NE(pair[0].key, jobs({"limits.jerk=30000"})[0].key);
  EXPECT_NE(pair[0].key, jobs({"limits.jerk=20000"}, JobMachine::kNone)[0].key);
  std::ofstream(file(), std::ios::app) << "(one more line)\n";
  EXPECT_NE(pair[0].key, jobs({"limits.jerk=20000"})[0].key);
}

TEST_F(BatchTest, EqualJobsRunOnceAndShardsAreAPartition) {
  const auto equal = jobs({"limits.jerk=20000", "limits.jerk=20000"});
  EXPECT_EQ(run_batch(equal, store(), {})->computed, 1U);
  const auto many = jobs({"limits.jerk=1e4", "limits.jerk=2e4", "limits.jerk=3e4"});
  std::size_t total = 0;
  for (const std::size_t shard : {0U, 1U}) {
    Options options;
    options.shard = shard;
    options.shards = 2;
    total += run_batch(many, *Store::open(folder / "other"), options)->computed;
  }
  EXPECT_EQ(total, 3U);
}

TEST_F(BatchTest, TwoStoresOfTheSameJobsHaveTheSameBytes) {
  const auto some = jobs({"limits.jerk=20000"}, JobMachine::kTable);
  const Store one = *Store::open(folder / "one");
  const Store two = *Store::open(folder / "two");
  ASSERT_TRUE(run_batch(some, one, {}));
  ASSERT_TRUE(run_batch(some, two, {}));
  for (const char* const name : {"summary.json", "job.json"}) {
    const std::string content = test::content(one.folder_of(some[0]) / name);
    EXPECT_GT(content.size(), 100U);
    EXPECT_EQ(content, test::content(two.folder_of(some[0]) / name));
  }
}

TEST_F(BatchTest, ABrokenResultIsComputedAgain) {
  const auto some = jobs({"limits.jerk=20000"});
  const Store kept = store();
  ASSERT_TRUE(run_batch(some, kept, {}));
  const auto file = kept.folder_of(some[0]) / "summary.json";
  const std::string whole = test::content(file);
  std::ofstream(file) << whole.substr(0, 40);
  const auto report = run_batch(some, kept, {});
  EXPECT_EQ(report->computed, 1U);
  EXPECT_EQ(report->redone, 1U);
  EXPECT_EQ(test::content(file), whole);
}

TEST_F(BatchTest, AResultOfAnotherSubprogramIsComputedAgain) {
  folder.put("step.ngc", "o<step> sub\nG1 X3 F1200\no<step> endsub\n");
  std::ofstream(file()) << "G21 G90\no<step> call\nM30\n";
  const auto count = [this] {
    const auto result = run_batch(jobs({"limits.jerk=20000"}), store(), {});
    return result ? result->computed : 99U;
  };
  EXPECT_EQ(count(), 1U);
  EXPECT_EQ(count(), 0U);
  folder.put("step.ngc", "o<step> sub\nG1 X4 F1200\no<step> endsub\n");
  EXPECT_EQ(count(), 1U);
  EXPECT_EQ(count(), 0U);
}

TEST_F(BatchTest, ARunThatFailsIsKeptWithItsReason) {
  const auto some = jobs({"limits.travel_max_mm=[1, 1, 1]", "limits.jerk=20000"});
  const auto report = run_batch(some, store(), {});
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->failed, 1U);
  EXPECT_EQ(report->computed, 2U);
  EXPECT_THAT(store().find(some[0])->failure, HasSubstr("travel"));
  EXPECT_EQ(run_batch(some, store(), {})->failed, 1U);
}

// A full disk while the trace was written was the job's result, and stayed so when there was room.
TEST_F(BatchTest, WhatAFullDiskCutShortIsNotKeptAndRunsAgain) {
  std::ofstream(file()) << "G21 G90\nG1 X30 Y10 F1200\nX0 Y40\nM30\n";
  JobMaker maker;
  std::vector<PreparedJob> both;
  for (const auto trace : {results::TraceFiles::kCsv, results::TraceFiles::kNone}) {
    Job job;
    job.program = file();
    job.hal = JobMachine::kIdeal;
    job.trace = trace;
    both.push_back(*maker.prepare(job));
  }
  {
    const test::FileSizeLimit full(30000);
    const auto report = run_batch(both, store(), {});
    ASSERT_FALSE(report);
    EXPECT_THAT(to_string(report.error()), HasSubstr("cannot write"));
    EXPECT_THAT(report.error().message, HasSubstr("1 of 2 jobs are not kept"));
    EXPECT_THAT(report.error().message, HasSubstr("run again at the next call"));
  }
  EXPECT_FALSE(store().find(both[0]));
  EXPECT_TRUE(store().find(both[1]));  // the other one has its result
  const auto again = run_batch(both, store(), {});
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(again->computed, 1U);
  EXPECT_EQ(again->found, 1U);
  EXPECT_EQ(again->failed, 0U);
}

TEST_F(BatchTest, AFolderThatIsNoStoreIsRefused) {
  const auto refused = Store::open(folder.path());  // it has a program in it
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("is no store"));
  const test::TempFolder other;
  std::ofstream(other / "twin-store.json") << "{\"layout\": 99}";
  EXPECT_THAT(Store::open(other.path()).error().message, HasSubstr("another layout"));
}

TEST_F(BatchTest, AStopLeavesWhatIsStored) {
  const std::atomic<bool> stop{true};
  Options options;
  options.stop = &stop;
  const auto report = run_batch(jobs({"limits.jerk=20000"}), store(), options);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kInterrupted);
}

TEST_F(BatchTest, ATraceIsKeptWhereItIsAskedFor) {
  JobMaker maker;
  Job job;
  job.program = file();
  job.hal = JobMachine::kIdeal;
  job.trace = results::TraceFiles::kBoth;
  const std::vector<PreparedJob> one{*maker.prepare(job)};
  const Store kept = store();
  ASSERT_TRUE(run_batch(one, kept, {}));
  EXPECT_THAT(test::content(kept.folder_of(one[0]) / "trace.csv"), HasSubstr("t_s,segment,line"));
  EXPECT_THAT(test::content(kept.folder_of(one[0]) / "trace.h5"), HasSubstr("HDF"));
}

TEST(JobFile, ALineIsReadBackAsItWasWritten) {
  const char* const line =
      R"({"program":"a.nc","machine":"m.toml","set":{"limits.jerk":2e4,"planning.planner":"paper"},)"
      R"("feedrate_mm_per_min":1500,"hal":"ideal","overrides":[[0,100],[1.5,50]],"trace":true})";
  const auto job = parse_job(line, "jobs.jsonl", 1);
  ASSERT_TRUE(job) << to_string(job.error());
  EXPECT_EQ(job->settings[1], "planning.planner=paper");
  EXPECT_DOUBLE_EQ(*job->feedrate, 25.0);
  const auto again = parse_job(to_line(*job), "jobs.jsonl", 1);
  ASSERT_TRUE(again);
  EXPECT_EQ(to_line(*again), to_line(*job));
  EXPECT_EQ(again->overrides.size(), 2U);
}

TEST(JobFile, WhatIsWrongIsSaidWithItsLine) {
  const std::vector<std::pair<const char*, const char*>> wrong{
      {"{\"program\": }", "no JSON"},
      {"[1]", "expected an object"},
      {"{}", "has no \"program\""},
      {"{\"program\":\"a.nc\",\"hall\":\"x\"}", "unknown key \"hall\"; did you mean hal?"},
      {"{\"program\":\"a.nc\",\"hal\":\"x\"}", "expected \"mujoco\""},
      {"{\"program\":\"a.nc\",\"feedrate_mm_per_min\":-1}", "above 0"},
      {"{\"program\":\"a.nc\",\"overrides\":[[2,100],[1,50]]}", "ascending"},
      {"{\"program\":\"a.nc\",\"set\":{\"a\":null}}", "a number, a text"}};
  for (const auto& [text, expected] : wrong) {
    const auto job = parse_job(text, "jobs.jsonl", 7);
    ASSERT_FALSE(job) << text;
    EXPECT_THAT(to_string(job.error()), HasSubstr("jobs.jsonl:7"));
    EXPECT_THAT(job.error().message, HasSubstr(expected));
  }
}

}  // namespace batch_test
}  // namespace twin::studies::batch
