
#include "tests/faults/rig_processes.hpp"

#include "core/json.hpp"

// Controller and plant as two programs in real time, to the end of the program.
namespace twin::test {
namespace wall_clock_run_test {

TEST(WallClockRun, LastsAsLongAsPlannedAndReportsItsTiming) {
  RigProcesses rig;
  rig.start_emulator();
  const double begin = monotonic();
  rig.start_controller("short.nc", kPatient);
  const auto result = rig.controller->wait();
  const double took = monotonic() - begin;
  ASSERT_EQ(result.status, 0) << result.err << rig.log();
  const auto summary = parse_json(content(rig.results() / "summary.json"));
  EXPECT_EQ(summary["hal"], "rig");
  EXPECT_EQ(summary["simulated"], true);
  const double planned = summary["planned_time_s"];
  EXPECT_NEAR(summary["machining_time_s"].get<double>(), planned, 0.001 + 1e-9);
  EXPECT_GE(took, planned + 0.3);  // it truly passed on the wall clock
  for (const char* what : {"wake_up_us", "compute_us", "total_us"}) {
    for (const char* figure : {"p50", "p99", "p99.9", "max"}) {
      EXPECT_GT(summary["realtime"][what][figure].get<double>(), 0.0) << what << " " << figure;
    }
  }
  EXPECT_TRUE(rig.safe_after(begin)) << rig.log();
}

}  // namespace wall_clock_run_test
}  // namespace twin::test
