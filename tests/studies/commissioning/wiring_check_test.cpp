#include "studies/commissioning/wiring_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "hal/mujoco/mujoco_machine.hpp"
#include "tests/support/table_files.hpp"

namespace twin::studies::commissioning {
namespace wiring_check_test {

using ::testing::HasSubstr;

/// The simulated table with faults in the wires between it and the controller.
class MiswiredTable final : public hal::Machine {
 public:
  MiswiredTable() : table_(test::default_table()), info_(table_.info()) {}

  const hal::MachineInfo& info() const noexcept override { return info_; }
  std::optional<Error> configure(double period) override { return table_.configure(period); }
  std::optional<Error> activate() override { return table_.activate(); }
  hal::Status read(hal::Inputs& inputs) noexcept override {
    const hal::Status status = table_.read(inputs);
    inputs.counts[hal::kX] *= x_sense;
    largest_travel = std::max(largest_travel, std::abs(table_.truth().table_position[hal::kX]));
    if (are_counters_swapped) {
      std::swap(inputs.counts[hal::kX], inputs.counts[hal::kY]);
    }
    if (is_alarm_open) {
      inputs.alarm[hal::kY] = true;
    }
    if (is_never_ready) {
      inputs.servo_ready = {};
    }
    if (is_counter_dead) {
      inputs.counts[hal::kX] = 0;
    }
    return status;
  }
  hal::Status write(const hal::Outputs& outputs) noexcept override {
    hal::Outputs wired = outputs;
    wired.volts[hal::kX] += offset;
    last_volts = outputs.volts;
    return table_.write(wired);
  }
  hal::Truth truth() const noexcept override { return table_.truth(); }
  void deactivate() noexcept override {
    is_off = true;
    table_.deactivate();
  }
  void cleanup() noexcept override { table_.cleanup(); }
  std::string last_error() const override { return table_.last_error(); }

  std::int64_t x_sense = 1;
  double offset = 0.0;
  bool are_counters_swapped = false;
  bool is_alarm_open = false;
  bool is_never_ready = false;
  bool is_counter_dead = false;
  bool is_off = false;
  double largest_travel = 0.0;
  std::array<double, 2> last_volts{};

 private:
  hal::mujoco::MujocoMachine table_;

 public:
  hal::MachineInfo info_;
};

class WiringCheck : public ::testing::Test {
 protected:
  Expected<WiringReport> check() {
    return check_wiring(
        machine, {}, 0.001, [] {}, stop);
  }
  MiswiredTable machine;
  std::atomic<bool> stop{false};
};

TEST_F(WiringCheck, SoundTableIsSoundAndItsScalesAreThoseOfTheDrives) {
  const auto report = check();
  ASSERT_TRUE(report) << report.error().message;
  for (const AxisWiringReport& axis : *report) {
    EXPECT_EQ(axis.finding, Finding::kSound) << advice(axis, "x");
    EXPECT_NEAR(axis.measured_scale / axis.expected_scale, 1.0, 0.1);
  }
  EXPECT_TRUE(machine.is_off);
  EXPECT_LT(machine.largest_travel, 1.0);
}

TEST_F(WiringCheck, EncoderTheWrongWayRoundIsReversed) {
  machine.x_sense = -1;
  const auto report = check();
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ((*report)[hal::kX].finding, Finding::kReversed);
  EXPECT_EQ((*report)[hal::kY].finding, Finding::kSound);
  EXPECT_THAT(advice((*report)[hal::kX], "x"), HasSubstr("rig.x.encoder_reversed"));
  EXPECT_LT(machine.largest_travel, 1.0);
}

TEST_F(WiringCheck, ScaleThatIsWrongIsMeasured) {
  machine.info_.mm_per_s_per_volt[hal::kX] *= 2.0;
  const auto report = check();
  ASSERT_TRUE(report) << report.error().message;
  const AxisWiringReport& x = (*report)[hal::kX];
  EXPECT_EQ(x.finding, Finding::kScale);
  EXPECT_NEAR(x.measured_scale / x.expected_scale, 0.5, 0.05);
  EXPECT_THAT(advice(x, "x"), HasSubstr("rig.x.encoder_um_per_count"));
}

TEST_F(WiringCheck, OffsetOfTheDriveIsMeasuredAndDoesNotSpoilTheScale) {
  machine.offset = 0.01;
  const auto report = check();
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_NEAR((*report)[hal::kX].offset(), 0.01, 0.002);
  EXPECT_EQ((*report)[hal::kX].finding, Finding::kSound);
}

TEST_F(WiringCheck, DeadCounterIsNoMotion) {
  machine.is_counter_dead = true;
  const auto report = check();
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ((*report)[hal::kX].finding, Finding::kNoMotion);
}

TEST_F(WiringCheck, SwappedCountersAreTheOtherAxis) {
  machine.are_counters_swapped = true;
  const auto report = check();
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ((*report)[hal::kX].finding, Finding::kOtherAxis);
  EXPECT_EQ((*report)[hal::kY].finding, Finding::kOtherAxis);
}

TEST_F(WiringCheck, RefusesAnAlarmBeforeAnythingMoves) {
  machine.is_alarm_open = true;
  const auto report = check();
  ASSERT_FALSE(report);
  EXPECT_THAT(report.error().message, HasSubstr("axis y: the drive has an alarm"));
  EXPECT_TRUE(machine.is_off);
  EXPECT_LT(machine.largest_travel, 0.01);
}

TEST_F(WiringCheck, DriveThatIsNeverReadyGetsNoVoltage) {
  machine.is_never_ready = true;
  const auto report = check();
  ASSERT_FALSE(report);
  EXPECT_THAT(report.error().message, HasSubstr("axis x: no /S-RDY within 2 s"));
  EXPECT_EQ(machine.last_volts[hal::kX], 0.0);
}

TEST_F(WiringCheck, AxisThatRunsAwayIsStoppedWithinTheTravelOfTheCheck) {
  machine.offset = 1.0;  // 83 mm/s
  const auto report = check();
  ASSERT_FALSE(report);
  EXPECT_THAT(report.error().message, HasSubstr("more than the 1.5 mm of this check"));
  EXPECT_TRUE(machine.is_off);
  EXPECT_LT(machine.largest_travel, 4.0);
}

TEST_F(WiringCheck, EndsWhenToldTo) {
  stop = true;
  const auto report = check();
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kInterrupted);
  EXPECT_TRUE(machine.is_off);
}

}  // namespace wiring_check_test
}  // namespace twin::studies::commissioning
