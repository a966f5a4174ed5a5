#include <algorithm>
#include <array>
#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include "tests/faults/guard_witness.hpp"
#include "tests/faults/rig_processes.hpp"
#include "tests/support/trace_rows.hpp"

// What happens to the outputs when a process of the rig dies, hangs or is told to stop: emulator
// and controller as two programs on the wall clock, seen from the emulator's log. A system under
// load stands still by itself for tens of milliseconds; so time in which neither the guard nor
// this process ran is left out (GuardWitness). guard_reaction_test.cpp has the distribution of the
// guard's reactions.
namespace twin::test {
namespace process_faults_test {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kInTime = 0.025;  // [s]
constexpr double kSoon = 0.2;      // [s]

/// Patient but for the guard, which waits as long as it does by default.
std::vector<std::string> with_heartbeats() {
  std::vector<std::string> settings = kPatient;
  settings.back() = "safety.heartbeat_timeout_ms=20";
  return settings;
}

/// A rig whose controller follows a long path.
class ProcessFault : public ::testing::Test {
 protected:
  /// Begins anew where a system that stood still ended the run before it moved.
  void start(const std::vector<std::string>& more = kPatient) {
    constexpr int kAttempts = 6;
    for (int i = 0; i < kAttempts; ++i) {
      rig.emplace();
      rig->start_emulator();
      rig->start_controller("long.nc", more);
      if (rig->waits_for_motion()) {
        return;
      }
    }
    FAIL() << rig->log() << rig->complaint();
  }
  /// Sends the controller a signal that ends or stops it.
  /// @returns how long the outputs were live after it, by the emulator's log [s]
  std::optional<double> reaction_to(int signal) {
    const auto guard = child_of(rig->controller->pid());
    if (!guard) {
      return std::nullopt;
    }
    const GuardView view(*guard);
    GuardWitness witness(view);
    const double fault = monotonic();
    rig->controller->signal(signal);
    const auto standstill = witness.standstill_until(fault, [&] { return view.has_acted(); });
    const auto safe = rig->safe_after(fault);
    return standstill && safe ? std::optional(*safe - *standstill) : std::nullopt;
  }
  void expect_partial_files() const {
    EXPECT_TRUE(std::filesystem::exists(rig->results() / "trace.partial.csv"));
    EXPECT_FALSE(std::filesystem::exists(rig->results() / "trace.csv"));
  }

  std::optional<RigProcesses> rig;
};

class FatalSignal : public ProcessFault, public ::testing::WithParamInterface<int> {};

TEST_P(FatalSignal, OutputsAreSafeWithinTwentyFiveMilliseconds) {
  ASSERT_NO_FATAL_FAILURE(start(with_heartbeats()));
  const auto reaction = reaction_to(GetParam());
  ASSERT_TRUE(reaction) << rig->log();
  EXPECT_LE(*reaction, kInTime);
  RecordProperty("safe_after_ms", std::to_string(*reaction * 1e3));
  EXPECT_NE(rig->controller->wait().status, 0);  // by the signal, or as a sanitizer has it
  expect_partial_files();
}

INSTANTIATE_TEST_SUITE_P(Signals, FatalSignal,
                         ::testing::Values(SIGKILL, SIGSEGV, SIGABRT, SIGFPE, SIGQUIT),
                         [](const auto& test) { return std::string(sigabbrev_np(test.param)); });

// The heartbeats are waited for most of the time, so a busy machine is late now and then: the median
// of three counts.
TEST_F(ProcessFault, ControllerThatHangsIsMadeSafeByTheGuardAndStaysSo) {
  std::array<double, 3> reactions{};
  for (double& reaction : reactions) {
    ASSERT_NO_FATAL_FAILURE(start(with_heartbeats()));
    const double before = monotonic();
    const auto measured = reaction_to(SIGSTOP);
    ASSERT_TRUE(measured) << rig->log();
    reaction = *measured;
    rig->controller->signal(SIGCONT);
    const auto result = rig->controller->wait();
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("the guard has made the outputs safe"));
    EXPECT_FALSE(rig->time_of("digital outputs 0x0005", before)) << rig->log();
    expect_partial_files();
  }
  std::sort(reactions.begin(), reactions.end());
  EXPECT_LE(reactions[1], kInTime) << "of " << reactions[0] << " to " << reactions[2] << " s";
  RecordProperty("safe_after_ms", std::to_string(reactions[1] * 1e3));
}

class PoliteSignal : public ProcessFault, public ::testing::WithParamInterface<int> {};

TEST_P(PoliteSignal, BrakesOnThePathAndLeavesTheOutputsSafe) {
  start();
  const double before = monotonic();
  rig->controller->signal(GetParam());
  const auto result = rig->controller->wait();
  EXPECT_EQ(result.status, 130);
  EXPECT_THAT(result.err, HasSubstr("interrupted: stopped on the path at t = "));
  EXPECT_TRUE(rig->safe_after(before)) << rig->log();
  expect_partial_files();
  EXPECT_EQ(TraceRows(rig->results() / "trace.partial.csv").last("feedrate_mm_per_s"), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Signals, PoliteSignal, ::testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& test) { return std::string(sigabbrev_np(test.param)); });

TEST_F(ProcessFault, ASecondSignalEndsTheRunAtOnceWithTheOutputsSafe) {
  start();
  const double before = monotonic();
  rig->controller->signal(SIGINT);
  rig->controller->signal(SIGTERM);
  const auto result = rig->controller->wait();
  EXPECT_GT(result.status, 1) << "it ended by itself";
  EXPECT_THAT(result.err, Not(HasSubstr("stopped on the path")));
  const auto safe = rig->safe_after(before);
  ASSERT_TRUE(safe) << rig->log();
  EXPECT_LT(*safe, kSoon);
}

TEST_F(ProcessFault, EmulatorThatIsKilledLooksLikeADeadEncoder) {
  std::vector<std::string> settings = kPatient;
  settings[3] = "safety.frozen_encoder=0.3";
  start(settings);
  rig->emulator->signal(SIGKILL);
  const auto result = rig->controller->wait();
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("axis x: encoder counts stand"));
  EXPECT_THAT(result.err, HasSubstr("NC line"));
  expect_partial_files();
}

TEST_F(ProcessFault, EmulatorThatEndsIsCardsThatAreGone) {
  start();
  rig->emulator->signal(SIGTERM);
  EXPECT_EQ(rig->emulator->wait().status, 0);
  const auto result = rig->controller->wait();
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("no longer answers"));
  expect_partial_files();
}

TEST_F(ProcessFault, WithoutItsGuardTheControllerStops) {
  start();
  const auto guard = child_of(rig->controller->pid());
  ASSERT_TRUE(guard);
  const double before = monotonic();
  kill(*guard, SIGKILL);
  const auto result = rig->controller->wait();
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("the guard process is gone"));
  EXPECT_TRUE(rig->safe_after(before)) << rig->log();
}

TEST_F(ProcessFault, SecondControllerIsRefused) {
  start();
  TempFolder folder;
  folder.put("ok.nc", "G01 X1 F100\nM30\n");
  const auto second = run_twin({"run", "ok.nc", "--hal", "rig", "--rig", "process", "--rig-name",
                                rig->name(), "--out", "out"},
                               {folder.path(), {}});
  EXPECT_EQ(second.status, 1);
  EXPECT_THAT(second.err, HasSubstr("drives the emulated rig already"));
}

}  // namespace process_faults_test
}  // namespace twin::test
