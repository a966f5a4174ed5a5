#include "hal/linuxcnc/linuxcnc_machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <mutex>
#include <thread>

#include "tests/hal/linuxcnc/fake_shim.hpp"

namespace twin::hal::linuxcnc {
namespace linuxcnc_machine_test {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// A component whose thread beats as twinctl's does.
class MachineTest : public ::testing::Test {
 protected:
  MachineTest() {
    shim.make(name);
    shim.memory->period = 1e-3;
    for (twin_axis& axis : shim.memory->axis) {
      axis.feedback.wired = TWIN_WIRED_COUNT | TWIN_WIRED_OUTPUT;
    }
  }
  ~MachineTest() override { end(); }

  void beat() {
    thread = std::thread([this] {
      while (!has_ended) {
        std::atomic_ref(shim.memory->periods_asked).fetch_add(1);
        if (shim.is_answered()) {
          if (at_beat) {
            at_beat(*shim.memory);
          }
          std::atomic_ref(shim.memory->asked).fetch_add(1, std::memory_order_release);
          ::syscall(SYS_futex, &shim.memory->asked, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
        }
        std::this_thread::sleep_for(1ms);
      }
    });
  }
  void end() {
    has_ended = true;
    if (thread.joinable()) {
      thread.join();
    }
  }
  std::string refusal() {
    const auto error = machine.configure(1e-3);
    return error ? error->message : "none";
  }
  void start() {
    beat();
    ASSERT_TRUE(checked(machine.configure(1e-3)));
    ASSERT_TRUE(checked(machine.activate()));
    outputs.servo_on = {true, true};
  }
  twin_axis& axis(std::size_t i) { return shim.memory->axis[i]; }

  const std::string name = test::unused_segment_name();
  test::FakeShim shim;
  std::function<void(twin_segment&)> at_beat;  // before a question
  std::atomic<bool> has_ended{false};
  std::thread thread;
  LinuxCncMachine machine{{{0.01, -0.02}, {80.0, 90.0}}, name};
  Inputs inputs;
  Outputs outputs;
};

TEST_F(MachineTest, IsRealAndGivesTheBeat) {
  EXPECT_FALSE(machine.info().simulated);
  EXPECT_TRUE(machine.info().keeps_own_time);
  EXPECT_TRUE(machine.info().gives_beat);
  EXPECT_FALSE(machine.info().has_truth);
}

TEST_F(MachineTest, RefusesToBeUsedBeforeItIsConfigured) {
  EXPECT_FALSE(checked(machine.activate()));
  EXPECT_EQ(machine.read(inputs), Status::kError);
  EXPECT_THAT(machine.last_error(), HasSubstr("before it was configured"));
  EXPECT_EQ(machine.write(outputs), Status::kError);
  EXPECT_FALSE(checked(machine.configure(std::numeric_limits<double>::quiet_NaN())));
}

TEST_F(MachineTest, ReadsCountsSinceItWasActivatedAndWritesVolts) {
  std::atomic<std::int64_t> counts{700};
  at_beat = [&](twin_segment& memory) { memory.axis[kX].feedback.counts = counts; };
  start();
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  EXPECT_EQ(inputs.counts[kX], 0);
  outputs.volts = {1.5, -2.5};
  ASSERT_EQ(machine.write(outputs), Status::kOk);
  counts = 723;
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  EXPECT_EQ(inputs.counts[kX], 23);
  EXPECT_EQ(axis(kX).command.volts, 1.5);
  EXPECT_EQ(axis(kY).command.volts, -2.5);
  EXPECT_EQ(axis(kY).command.servo_on, 1U);
  EXPECT_EQ(shim.memory->is_running, 1U);
  machine.deactivate();
  EXPECT_EQ(axis(kX).command.volts, 0.0);
  EXPECT_EQ(axis(kX).command.servo_on, 0U);
  EXPECT_EQ(shim.memory->is_running, 0U);
}

TEST_F(MachineTest, MakesCountsOfAPosition) {
  std::atomic<double> position{1.0};
  axis(kY).feedback.wired = TWIN_WIRED_POSITION | TWIN_WIRED_OUTPUT;
  at_beat = [&](twin_segment& memory) { memory.axis[kY].feedback.position = position; };
  start();
  position = 1.1001;
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  ASSERT_EQ(machine.write(outputs), Status::kOk);
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  EXPECT_EQ(inputs.counts[kY], -5);  // 0.1001 mm at -0.02 mm a count
}

TEST_F(MachineTest, ADriveWithoutAReadyPinIsReadyOnceItIsOn) {
  start();
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  EXPECT_FALSE(inputs.servo_ready[kX]);
  ASSERT_EQ(machine.write(outputs), Status::kOk);
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  EXPECT_TRUE(inputs.servo_ready[kX]);
}

TEST_F(MachineTest, CountsThePeriodsThatItWasTooLateFor) {
  start();
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  EXPECT_EQ(inputs.periods, 1);
  ASSERT_EQ(machine.write(outputs), Status::kOk);
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  std::this_thread::sleep_for(50ms);
  ASSERT_EQ(machine.write(outputs), Status::kOk);
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  EXPECT_GT(inputs.periods, 10);
}

TEST_F(MachineTest, NamesPinsThatLeadNowhere) {
  axis(kX).feedback.wired = TWIN_WIRED_OUTPUT;
  beat();
  EXPECT_THAT(refusal(), HasSubstr("nothing in HAL is connected to twinctl.x.count"));
  axis(kX).feedback.wired = TWIN_WIRED_COUNT;
  EXPECT_THAT(refusal(), HasSubstr("twinctl.x.volts and twinctl.x.velocity-cmd lead nowhere"));
  axis(kX).feedback.wired = TWIN_WIRED_COUNT | TWIN_WIRED_OUTPUT;
  axis(kY).name[0] = 'a';
  EXPECT_THAT(refusal(), HasSubstr("twinctl has no axis y"));
}

TEST_F(MachineTest, RefusesAThreadOfAnotherPeriod) {
  shim.memory->period = 2e-3;
  beat();
  EXPECT_THAT(refusal(), HasSubstr("a period of 2.0000 ms, and interpolator.period_ms is 1.0000"));
}

TEST_F(MachineTest, RefusesAThreadThatStands) {
  EXPECT_THAT(refusal(), HasSubstr("does not call twinctl.read"));
}

TEST_F(MachineTest, RefusesAnAlarmThatStaysAndResetsOneThatGoes) {
  std::atomic<bool> stays{true};
  at_beat = [&](twin_segment& memory) {
    twin_axis& y = memory.axis[kY];
    y.feedback.alarm = stays || (y.feedback.alarm != 0 && y.command.fault_reset == 0) ? 1 : 0;
  };
  beat();
  ASSERT_TRUE(checked(machine.configure(1e-3)));
  const auto refused = machine.activate();
  ASSERT_TRUE(refused);
  EXPECT_THAT(refused->message, HasSubstr("axis y: the drive has an alarm after its reset"));
  stays = false;
  EXPECT_TRUE(checked(machine.activate()));
}

TEST_F(MachineTest, WaitsUntilTheAxesStand) {
  std::atomic<int> left{100};  // periods that X still moves for
  at_beat = [&](twin_segment& memory) {
    if (left > 0) {
      --left;
      memory.axis[kX].feedback.counts += 3;
    }
  };
  beat();
  ASSERT_TRUE(checked(machine.configure(1e-3)));
  ASSERT_TRUE(checked(machine.activate()));
  EXPECT_EQ(left, 0);
  EXPECT_EQ(shim.memory->is_running, 0U);
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  EXPECT_EQ(inputs.counts[kX], 0);
}

TEST_F(MachineTest, EndsWhenTheComponentHasSwitchedOff) {
  start();
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  ASSERT_EQ(machine.write(outputs), Status::kOk);
  shim.memory->hold_periods = 3;
  std::atomic_ref(shim.memory->has_switched_off).store(1);
  EXPECT_EQ(machine.read(inputs), Status::kError);
  EXPECT_THAT(machine.last_error(), HasSubstr("more than 3 periods in a row"));
  EXPECT_EQ(machine.write(outputs), Status::kError);
}

TEST_F(MachineTest, EndsAtTheEmergencyStop) {
  start();
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  ASSERT_EQ(machine.write(outputs), Status::kOk);
  shim.memory->is_estop = 1;
  EXPECT_EQ(machine.read(inputs), Status::kError);
  EXPECT_THAT(machine.last_error(), HasSubstr("emergency stop"));
}

TEST_F(MachineTest, EndsWhenTheThreadStandsOrTheComponentIsGone) {
  start();
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  ASSERT_EQ(machine.write(outputs), Status::kOk);
  end();
  while (machine.read(inputs) == Status::kOk) {
    ASSERT_EQ(machine.write(outputs), Status::kOk);
  }
  EXPECT_THAT(machine.last_error(), HasSubstr("has stood for 100 ms"));
  shim.leave();
  EXPECT_FALSE(checked(machine.activate()));
}

TEST_F(MachineTest, TellsWhatThePinsAskOfTheFeed) {
  shim.memory->feed_override = 1.0;
  start();
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  EXPECT_EQ(machine.feed_wish(), (FeedWish{false, 100.0}));
  ASSERT_EQ(machine.write(outputs), Status::kOk);
  shim.memory->is_hold = 1;
  shim.memory->feed_override = 0.5;
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  EXPECT_EQ(machine.feed_wish(), (FeedWish{true, 50.0}));
}

TEST_F(MachineTest, RefusesOutputsThatAreNoNumbers) {
  start();
  ASSERT_EQ(machine.read(inputs), Status::kOk);
  outputs.volts[kX] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(machine.write(outputs), Status::kError);
  EXPECT_EQ(axis(kX).command.volts, 0.0);
}

}  // namespace linuxcnc_machine_test
}  // namespace twin::hal::linuxcnc
