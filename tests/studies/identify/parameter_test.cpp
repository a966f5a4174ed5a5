#include "studies/identify/parameter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace twin::studies::identify {
namespace parameter_test {

using ::testing::HasSubstr;

ParameterSet set_of(std::vector<Parameter> parameters) {
  auto set = ParameterSet::create(std::move(parameters));
  EXPECT_TRUE(set) << (set ? "" : to_string(set.error()));
  return set.value_or(ParameterSet());
}

std::string refusal(std::vector<Parameter> parameters) {
  const auto set = ParameterSet::create(std::move(parameters));
  EXPECT_FALSE(set);
  EXPECT_TRUE(set || set.error().code == ErrorCode::kUsage);
  return set ? "" : set.error().message;
}

TEST(Parameter, LogarithmicScaleMakesEqualRatiosEqualSteps) {
  const Parameter p{"table.x.coulomb_friction_N", 0.5, 50.0, Scale::kLogarithmic};
  EXPECT_DOUBLE_EQ(from_unit(p, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(from_unit(p, 0.5), 5.0);
  EXPECT_DOUBLE_EQ(from_unit(p, 1.0), 50.0);
  EXPECT_DOUBLE_EQ(to_unit(p, 5.0), 0.5);
}

TEST(Parameter, LinearScaleMakesEqualDifferencesEqualSteps) {
  const Parameter p{"servo.x.kf", 0.9, 1.1, Scale::kLinear};
  EXPECT_DOUBLE_EQ(from_unit(p, 0.25), 0.95);
  EXPECT_NEAR(to_unit(p, 0.95), 0.25, 1e-12);
}

TEST(ParameterSet, ValuesAreInTheUnitsOfTheKeys) {
  const ParameterSet set = set_of({{"table.x.output_delay", 0.01, 2.0, Scale::kLogarithmic},
                                   {"table.y.bristle_stiffness_N_per_um", 0.01, 100.0},
                                   {"servo.y.kp_per_s", 10.0, 300.0}});
  EXPECT_EQ(set[0].key, "table.x.output_delay_ms");
  config::MachineFile machine;
  machine.servo[hal::kY].kp = 123.0;
  const std::vector<double> values = set.values(machine);
  EXPECT_DOUBLE_EQ(values[0], 0.3);
  EXPECT_DOUBLE_EQ(values[1], 10.0);
  EXPECT_DOUBLE_EQ(values[2], 123.0);
  const config::MachineFile changed =
      set.with_values(machine, std::vector<double>{0.5, 20.0, 100.0});
  EXPECT_DOUBLE_EQ(changed.table.axis[hal::kX].drive.output_delay, 0.5e-3);
  EXPECT_DOUBLE_EQ(changed.table.axis[hal::kY].friction.bristle_stiffness, 20e3);
  EXPECT_DOUBLE_EQ(changed.servo[hal::kY].kp, 100.0);
  EXPECT_DOUBLE_EQ(machine.servo[hal::kY].kp, 123.0);
}

TEST(ParameterSet, UnitsThereAndBackLeaveTheMachineAsItIs) {
  const ParameterSet set = set_of({{"table.x.velocity_gain_Hz", 1.0, 300.0, Scale::kLogarithmic},
                                   {"table.x.vref_offset_mV", -50.0, 50.0}});
  const config::MachineFile machine;
  const config::MachineFile same = set.with_units(machine, set.units(machine));
  EXPECT_DOUBLE_EQ(same.table.axis[hal::kX].drive.velocity_gain_Hz, 30.0);
  EXPECT_NEAR(same.table.axis[hal::kX].drive.vref_offset, 0.0, 1e-15);
}

TEST(ParameterSet, WhatCannotBeFittedIsRefusedByName) {
  EXPECT_THAT(refusal({{"table.x.coulomb_frction_N", 1.0, 2.0}}),
              HasSubstr("did you mean table.x.coulomb_friction_N"));
  EXPECT_THAT(refusal({{"table.x.dac_bits", 8.0, 16.0}}), HasSubstr("not a single number"));
  EXPECT_THAT(refusal({{"servo.x.kp", 1.0, 2.0}, {"servo.x.kp_per_s", 1.0, 2.0}}),
              HasSubstr("servo.x.kp_per_s is named twice"));
  EXPECT_THAT(refusal({{"servo.x.kf", 1.0, 1.0}}), HasSubstr("no range"));
  EXPECT_THAT(refusal({{"servo.x.kf", 0.0, 1.0, Scale::kLogarithmic}}), HasSubstr("no range"));
  EXPECT_THAT(refusal({{"servo.x.kf", 0.0, 100.0}}), HasSubstr("not inside -10 to 10"));
}

}  // namespace parameter_test
}  // namespace twin::studies::identify
