#include "hal/mujoco/change.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/mujoco/mujoco_machine.hpp"
#include "hal/mujoco/screw.hpp"
#include "hal/mujoco/table_plant.hpp"

namespace twin::hal::mujoco {
namespace change_test {

using ::testing::HasSubstr;

TEST(Change, TextIsReadAndWrittenBack) {
  for (const char* const text : {"friction:x=1.3@2", "vref_gain:y=0.95@1+5", "encoder_slip:x=1@0",
                                 "force:y=-4.5@0.25+0.5"}) {
    const auto change = parse_change(text);
    ASSERT_TRUE(change) << to_string(change.error());
    EXPECT_EQ(to_string(*change), text);
  }
}

TEST(Change, WhatIsWrongWithATextIsSaid) {
  for (const auto& [text, words] : {std::pair{"friction:x=1.3", "does not have an axis"},
                                    {"wear:x=1@2", "'wear' is no kind"},
                                    {"friction:z=1.3@2", "axis 'z'"},
                                    {"friction:x=much@2", "'much' is no value from 0 to 100"},
                                    {"friction:x=1000@2", "'1000' is no value"},
                                    {"friction:x=1.3@-1", "no time in seconds"},
                                    {"friction:x=1.3@1+", "no time in seconds"},
                                    {"", "does not have"}}) {
    const auto change = parse_change(text);
    ASSERT_FALSE(change) << text;
    EXPECT_THAT(change.error().message, HasSubstr(words));
    EXPECT_THAT(change.error().message, HasSubstr("encoder_slip"));
  }
}

TEST(Change, ComesAtItsTimeAtOnceOrSlowly) {
  const std::vector<Change> changes{{ChangeKind::kFriction, kX, 1.5, 1.0, 0.0},
                                    {ChangeKind::kVrefOffset, kY, 10.0, 2.0, 4.0}};
  EXPECT_EQ(condition_at(changes, kX, 0.999).friction, 1.0);
  EXPECT_EQ(condition_at(changes, kX, 1.0).friction, 1.5);
  EXPECT_EQ(condition_at(changes, kX, 9.0).vref_offset, 0.0);
  EXPECT_NEAR(condition_at(changes, kY, 3.0).vref_offset, 2.5e-3, 1e-12);
  EXPECT_NEAR(condition_at(changes, kY, 60.0).vref_offset, 10e-3, 1e-12);
}

TEST(Screw, PlayPassesNoForceAndAFlankDoesNotPull) {
  EXPECT_EQ(screw_force({0.002, 1.0}, 60e3, 4.0, 0.005), 0.0);
  EXPECT_NEAR(screw_force({0.0035, 0.0}, 60e3, 4.0, 0.005), 60.0, 1e-9);
  EXPECT_NEAR(screw_force({-0.0035, 0.0}, 60e3, 4.0, 0.005), -60.0, 1e-9);
  EXPECT_EQ(screw_force({0.0026, -100.0}, 60e3, 4.0, 0.005), 0.0);
  EXPECT_EQ(screw_force({0.0035, 2.0}, 60e3, 4.0, 0.0), 218.0);
}

/// Volts for a time; the position of the encoder at its end.
double driven(const TableParams& params, double volts, double time) {
  auto plant = TablePlant::open(params, 0.001);
  EXPECT_TRUE(plant) << (plant ? "" : to_string(plant.error()));
  for (int i = 0; i < static_cast<int>(time / 0.001); ++i) {
    (*plant)->command(kX, volts, true);
    EXPECT_TRUE((*plant)->advance());
  }
  return (*plant)->encoder_position(kX);
}

TableParams table() {
  TableParams params;
  params.model = TWIN_SOURCE_DIR "/mjcf/xy_table.xml";
  params.axis[kX].drive.hum_amplitude = 0.0;
  return params;
}

TEST(Change, GainAndLostEdgesShowInTheEncodersWay) {
  const double plain = driven(table(), 0.5, 2.0);
  TableParams changed = table();
  changed.changes = {{ChangeKind::kVrefGain, kX, 0.9, 0.0, 0.0}};
  EXPECT_NEAR(driven(changed, 0.5, 2.0) / plain, 0.9, 0.002);
  changed.changes = {{ChangeKind::kEncoderSlip, kX, 100.0, 0.0, 0.0}};
  EXPECT_NEAR(driven(changed, 0.5, 2.0) / plain, 0.9, 0.002);
  // A negative scale counts the other way, and loses as much of the way.
  changed.axis[kX].encoder.mm_per_count *= -1.0;
  EXPECT_NEAR(driven(changed, 0.5, 2.0) / plain, 0.9, 0.002);
}

TEST(Change, FrictionShiftsTheWayByWhatTheDrivesIntegralHolds) {
  const double plain = driven(table(), 0.5, 1.0);
  TableParams changed = table();
  changed.changes = {{ChangeKind::kFriction, kX, 2.0, 0.5, 0.0}};
  const AxisParams& axis = changed.axis[kX];
  const double speed = 0.5 * axis.mm_per_s_per_volt();
  const double force = axis.friction.coulomb + axis.friction.viscous * speed;
  const double mass = axis.moving_mass + axis.rotor_mass();
  // At rest of the transient the integral gives the force: M K / Ti times the lag.
  const double lag =
      force * axis.drive.integral_time / (mass * 2.0 * M_PI * axis.drive.velocity_gain_Hz) * 1e3;
  EXPECT_NEAR(plain - driven(changed, 0.5, 1.0), lag, 0.02 * lag);
}

TEST(Change, StiffnessAndPlayNeedScrewsThatGive) {
  TableParams params = table();
  params.changes = {{ChangeKind::kBacklash, kX, 5.0, 0.0, 0.0}};
  const auto refused = TablePlant::open(params, 0.001);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("xy_table_compliant.xml"));
  params.changes = {{ChangeKind::kLoad, kX, 500.0, 0.0, 0.0}};
  EXPECT_FALSE(TablePlant::open(params, 0.001));
}

TEST(Change, AScrewOfOurOwnMovesAsMujocosUntilSomethingDiffers) {
  TableParams params = table();
  params.model = TWIN_SOURCE_DIR "/mjcf/xy_table_compliant.xml";
  const double plain = driven(params, 0.5, 0.5);
  params.changes = {{ChangeKind::kStiffness, kX, 1.0, 0.0, 0.0}};
  EXPECT_NEAR(driven(params, 0.5, 0.5), plain, 1e-9);
  params.changes = {{ChangeKind::kBacklash, kX, 50.0, 0.0, 0.0}};
  EXPECT_NE(driven(params, 0.5, 0.5), plain);
}

}  // namespace change_test
}  // namespace twin::hal::mujoco
