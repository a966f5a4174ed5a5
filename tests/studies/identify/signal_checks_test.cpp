#include "studies/identify/signal_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace twin::studies::identify {
namespace signal_checks_test {

constexpr double kScale = 35.0;  // of the drive [N/V]
constexpr std::size_t kRows = 6000;

/// A machine in torque mode of kScale.
config::MachineFile torque_machine() {
  config::MachineFile machine;
  machine.period = 1e-3;
  machine.table.axis[hal::kX].drive.mode = hal::mujoco::DriveMode::kTorque;
  machine.table.axis[hal::kX].drive.force_scale = kScale;
  return machine;
}

/// Drive commands, and the force of them by a factor that is a function of the row.
template <class Factor>
AxisRecord record_of(Factor factor) {
  AxisRecord record;
  for (std::size_t k = 0; k < kRows; ++k) {
    const double t = static_cast<double>(k) * 1e-3;
    record.volts.push_back(2.0 * std::sin(7.0 * t) + std::sin(31.0 * t));
    record.force.push_back(kScale * factor(t) * record.volts.back());
  }
  return record;
}

template <class Factor>
std::string refusal(Factor factor) {
  const AxisRecord record = record_of(factor);
  const auto checked = check_signals({&record, 1}, hal::kX, torque_machine());
  return checked ? std::string() : checked.error().message;
}

TEST(SignalChecks, ForceThatIsTheDriveCommandTimesItsScaleIsTaken) {
  EXPECT_EQ(refusal([](double) { return 1.0; }), "");
  EXPECT_EQ(refusal([](double t) { return 1.0 + 0.05 * std::sin(100.0 * t); }), "") << "noise";
}

TEST(SignalChecks, ForceOfAnotherScaleIsRefusedWithBothGains) {
  EXPECT_THAT(refusal([](double) { return 0.6; }),
              ::testing::AllOf(::testing::HasSubstr("21 N/V"), ::testing::HasSubstr("35 N/V")));
}

// Its mean is that of the machine file, and it goes with the drive command well enough.
TEST(SignalChecks, ForceWhoseGainChangesOnTheWayIsRefusedThoughItsMeanIsRight) {
  EXPECT_THAT(
      refusal([](double t) { return 1.0 + 0.4 * std::sin(3.3 * t); }),
      ::testing::AllOf(::testing::HasSubstr("contradict"), ::testing::HasSubstr("N/V in others"),
                       ::testing::HasSubstr("35 N/V")));
  EXPECT_THAT(refusal([](double t) { return t < 3.0 ? 1.17 : 0.83; }),
              ::testing::HasSubstr("contradict"));
}

}  // namespace signal_checks_test
}  // namespace twin::studies::identify
