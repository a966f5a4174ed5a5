#include "hal/linuxcnc/serve_plant.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>
#include <vector>

#include "hal/linuxcnc/shared_segment.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "tests/hal/linuxcnc/fake_shim.hpp"
#include "tests/support/table_files.hpp"

namespace twin::hal::linuxcnc {
namespace serve_plant_test {

using rig::emulator::FaultKind;
using ::testing::Contains;
using ::testing::HasSubstr;

/// A plant in a thread of its own.
class PlantTest : public ::testing::Test {
 protected:
  ~PlantTest() override { end(); }

  void start() {
    settings.setup.table = test::default_table();
    settings.name = name;
    settings.started = [this](const std::string&) { is_up = true; };
    stop = false;
    is_up = false;
    thread = std::thread([this] {
      result = serve_plant(settings, stop, [this](std::string_view line) {
        const std::lock_guard lock(mutex);
        lines.emplace_back(line);
      });
      is_up = true;
    });
    while (!is_up) {
      std::this_thread::yield();
    }
  }
  void end() {
    stop = true;
    if (thread.joinable()) {
      thread.join();
    }
  }
  std::vector<std::string> told() {
    const std::lock_guard lock(mutex);
    return lines;
  }
  /// Whether a line with this text comes within a second.
  bool is_told_soon(const std::string& text) {
    for (int i = 0; i < 100; ++i) {
      for (const std::string& line : told()) {
        if (line.find(text) != std::string::npos) {
          return true;
        }
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  const std::string name = test::unused_segment_name();
  ServeSettings settings;
  std::atomic<bool> stop{false};
  std::atomic<bool> is_up{false};
  std::thread thread;
  std::mutex mutex;
  std::vector<std::string> lines;
  Expected<ServeResult> result;
  test::FakeShim shim;
};

TEST_F(PlantTest, EachPeriodAskedIsOneSimulated) {
  start();
  shim.attach(name);
  for (int i = 0; i < 20000; ++i) {
    ASSERT_TRUE(shim.pass_period());
  }
  end();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->asked, 20000);
  EXPECT_EQ(result->simulated, 20000);
  EXPECT_NEAR(result->time, 20.0, 1e-9);
}

TEST_F(PlantTest, AnswersWhatTheSimulatedTableOfThisProcessDoes) {
  start();
  shim.attach(name);
  mujoco::MujocoMachine machine(test::default_table());
  ASSERT_TRUE(checked(machine.configure(1e-3)));
  ASSERT_TRUE(checked(machine.activate()));
  Inputs inputs;
  Outputs outputs;
  outputs.servo_on = {true, true};
  for (int i = 0; i < 800; ++i) {
    for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
      outputs.volts[axis] = std::sin(0.02 * i + static_cast<double>(axis));
      shim.memory->axis[axis].command.volts = outputs.volts[axis];
      shim.memory->axis[axis].command.servo_on = 1;
    }
    ASSERT_TRUE(shim.pass_period());
    ASSERT_EQ(machine.write(outputs), Status::kOk);
    ASSERT_EQ(machine.read(inputs), Status::kOk);
    for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
      const twin_feedback& feedback = shim.memory->axis[axis].feedback;
      ASSERT_EQ(feedback.counts, inputs.counts[axis]) << i;
      ASSERT_EQ(feedback.table_position, machine.truth().table_position[axis]) << i;
      ASSERT_EQ(feedback.torque, machine.truth().motor_torque[axis]) << i;
      ASSERT_EQ(feedback.ready != 0, inputs.servo_ready[axis]) << i;
    }
  }
  EXPECT_GT(std::abs(inputs.counts[kX]), 100);
}

TEST_F(PlantTest, TellsThatLinuxCncHasComeAndGone) {
  start();
  shim.attach(name);
  ASSERT_TRUE(shim.pass_period());
  EXPECT_TRUE(is_told_soon("LinuxCNC has come"));
  shim.memory->axis[0].command.volts = 1.0;
  shim.memory->axis[0].command.servo_on = 1;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(shim.pass_period());
  }
  shim.leave();
  EXPECT_TRUE(is_told_soon("LinuxCNC is gone"));
  test::FakeShim next;
  next.attach(name);
  EXPECT_TRUE(next.pass_period());
}

TEST_F(PlantTest, IsTheOnlyOneOfItsName) {
  start();
  const auto other = SharedSegment::make_plant(name);
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr("a plant is running already"));
}

TEST_F(PlantTest, TakesOverWhatAKilledOneHasLeft) {
  start();
  shim.attach(name);
  ASSERT_TRUE(shim.pass_period());
  end();  // a component is attached: the memory stays
  shim.ask();
  EXPECT_FALSE(shim.wait(std::chrono::milliseconds(50)));
  start();
  EXPECT_TRUE(shim.wait());
  EXPECT_TRUE(shim.pass_period());
}

TEST_F(PlantTest, SaysThatTheThreadHasAnotherPeriod) {
  start();
  shim.attach(name);
  shim.memory->seen_period = 0.002;
  EXPECT_TRUE(is_told_soon("a period of 2.000 ms, this plant one of 1.000 ms"));
}

TEST_F(PlantTest, RefusesAFaultOfACard) {
  settings.setup.faults = {{FaultKind::kCardGone1716, 0, 1.0}};
  start();
  end();
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, HasSubstr("card_gone_1716 is about a card of the rig"));
}

TEST_F(PlantTest, FaultsStrikeByTheirTimeAndByTheComponent) {
  settings.setup.faults = {{FaultKind::kLimitPositive, kX, 0.1}};
  start();
  shim.attach(name);
  twin_axis& x = shim.memory->axis[kX];
  twin_axis& y = shim.memory->axis[kY];
  x.command.servo_on = 1;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(shim.pass_period());
  }
  EXPECT_EQ(x.feedback.limit_positive, 0);
  y.command.faults = TWIN_FAULT_LIMIT_NEGATIVE | TWIN_FAULT_ALARM;
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(shim.pass_period());
  }
  EXPECT_EQ(x.feedback.limit_positive, 1);
  EXPECT_EQ(y.feedback.limit_negative, 1);
  EXPECT_EQ(y.feedback.alarm, 1);
  y.command.faults = 0;
  y.command.fault_reset = 1;
  ASSERT_TRUE(shim.pass_period());
  EXPECT_EQ(y.feedback.limit_negative, 0);
  EXPECT_EQ(y.feedback.alarm, 0);
  EXPECT_THAT(told(), Contains(HasSubstr("fault limit_positive:x@0.1")));
}

TEST_F(PlantTest, PassesAnIndexMarkARevolution) {
  start();
  shim.attach(name);
  twin_axis& x = shim.memory->axis[kX];
  x.command.servo_on = 1;
  x.command.volts = 0.5;  // 41.7 mm/s
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(shim.pass_period());
  }
  const double position = x.feedback.position;
  const auto marks = static_cast<std::uint32_t>(std::floor(position / 10.0 + 0.5));
  EXPECT_EQ(x.feedback.index_marks, marks);
  EXPECT_NEAR(static_cast<double>(x.feedback.index_counts) * x.mm_per_count, 10.0 * marks - 5.0,
              x.mm_per_count);
}

}  // namespace serve_plant_test
}  // namespace twin::hal::linuxcnc
