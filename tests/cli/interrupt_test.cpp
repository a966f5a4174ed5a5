#include <chrono>
#include <csignal>
#include <thread>

#include "core/json.hpp"
#include "core/limits.hpp"
#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"
#include "tests/support/trace_rows.hpp"

// Ctrl-C brakes on the path, stops the machine and keeps what was recorded.
namespace twin::cli {
namespace interrupt_test {

class Interrupt : public test::CliTest, public ::testing::WithParamInterface<int> {
 protected:
  Interrupt() {
    // A minute of straight line along X.
    folder.put("long.nc", "G01 F600 X150\nX-150\nX150\n");
  }

  /// Waits until the file of the trace has grown beyond its header.
  void wait_for_samples() const {
    for (int i = 0; i < 3000; ++i) {
      std::error_code missing;
      if (std::filesystem::file_size(folder / "out/trace.partial.csv", missing) > 1000 &&
          !missing) {
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << "no sample was written";
  }
};

TEST_P(Interrupt, BrakesOnThePathAndLeavesATraceNamedAsPartial) {
  test::Child child({"run", "long.nc", "--out", "out", "--no-plots", "--quiet", "--realtime"},
                    {folder.path(), {}});
  wait_for_samples();
  child.signal(GetParam());
  const auto result = child.wait();
  expect_refusal(result, 130, "interrupted: stopped on the path at t = ");
  EXPECT_THAT(result.err, ::testing::HasSubstr("NC line 1"));
  EXPECT_TRUE(exists("out/summary.partial.json"));
  const test::TraceRows rows(folder / "out/trace.partial.csv");
  ASSERT_GT(rows.rows(), 100U);
  EXPECT_EQ(rows.last("feedrate_mm_per_s"), 0.0);
  EXPECT_EQ(rows.last("y_cmd_mm"), 0.0);
  EXPECT_LT(rows.last("x_cmd_mm"), 150.0);
  test::expect_within_limits(rows.column("x_cmd_mm"), 0.001, Limits{}, 10.0);
  const auto summary = parse_json(test::content(folder / "out/summary.partial.json"));
  EXPECT_NEAR(summary["machining_time_s"].get<double>(), rows.last("t_s"), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, ::testing::Values(SIGINT, SIGTERM),
                         [](const auto& test) { return test.param == SIGINT ? "Int" : "Term"; });

class InterruptInSimulatedTime : public Interrupt {};

TEST_P(InterruptInSimulatedTime, BrakesOnThePathAndLeavesATraceNamedAsPartial) {
  folder.put("slow.nc", "G01 F30 X150\nX-150\nX150\n");  // half an hour
  test::Child child(
      {GetParam() == SIGINT ? "run" : "plan", "slow.nc", "--out", "out", "--no-plots", "--quiet"},
      {folder.path(), {}});
  wait_for_samples();
  child.signal(GetParam());
  expect_refusal(child.wait(), 130, "interrupted: stopped on the path at t = ");
  const test::TraceRows rows(folder / "out/trace.partial.csv");
  EXPECT_EQ(rows.last("feedrate_mm_per_s"), 0.0);
  test::expect_within_limits(rows.column("x_cmd_mm"), 0.001, Limits{}, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptInSimulatedTime, ::testing::Values(SIGINT, SIGTERM),
                         [](const auto& test) { return test.param == SIGINT ? "Int" : "Term"; });

class InterruptTwice : public Interrupt {
 protected:
  /// Waits until a process has been given a signal: one that is sent while another is pending would
  /// be the same one. What is pending is a hexadecimal mask in /proc.
  static bool has_taken(pid_t process, int signal) {
    const std::string key = "ShdPnd:";
    for (int i = 0; i < 5000; ++i) {
      const std::string status = test::content("/proc/" + std::to_string(process) + "/status");
      const std::size_t at = status.find(key);
      if (at == std::string::npos) {
        return false;
      }
      const auto pending = std::stoull(status.substr(at + key.size()), nullptr, 16);
      if ((pending >> (signal - 1) & 1U) == 0) {
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }
};

TEST_P(InterruptTwice, SecondOneEndsTheProcess) {
  test::Child child(
      {"run", "long.nc", "--out", "out", "--no-plots", "--realtime", "--set", "limits.jerk=10"},
      {folder.path(), {}});  // so gentle that braking takes two seconds
  wait_for_samples();
  child.signal(GetParam());
  ASSERT_TRUE(has_taken(child.pid(), GetParam()));
  child.signal(GetParam());
  EXPECT_EQ(child.wait().status, 128 + GetParam());
  EXPECT_FALSE(exists("out/trace.csv"));
  EXPECT_TRUE(exists("out/trace.partial.csv"));
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptTwice, ::testing::Values(SIGINT));

}  // namespace interrupt_test
}  // namespace twin::cli
