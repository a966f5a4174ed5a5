#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "hal/mujoco/table_axis.hpp"
#include "hal/mujoco/table_physics.hpp"
#include "tests/support/table_files.hpp"

// Steady sliding at constant velocity: the motor's torque is what friction takes.
namespace twin::hal::mujoco {
namespace stribeck_curve_test {

constexpr double kStep = 1e-4;  // [s]

/// One axis of the table under its drive, the other at rest, as MujocoMachine steps them.
class DrivenAxis {
 public:
  DrivenAxis(const TableParams& params, Axis axis)
      : axis_(axis),
        physics_(TablePhysics::open(params, kStep).value()),
        parts_(params.axis[axis], kStep),
        mm_per_rad_(params.axis[axis].mm_per_rad()) {}

  void command(double volts) { parts_.command(volts, true); }
  /// One physics step. @returns force of the motor on the slide [N]
  double step() {
    const AxisForces forces = parts_.step(physics_->motion(axis_), time_);
    physics_->apply(axis_, forces);
    physics_->step();
    time_ += kStep;
    return forces.torque / units::m_from_mm(mm_per_rad_);
  }
  double velocity() const { return physics_->motion(axis_).velocity; }  // [mm/s]

 private:
  Axis axis_;
  std::unique_ptr<TablePhysics> physics_;
  TableAxis parts_;
  double mm_per_rad_;
  double time_ = 0.0;
};

class SteadySliding : public ::testing::TestWithParam<Axis> {};

TEST_P(SteadySliding, ForceFollowsTheStribeckFormulaWithinOnePercent) {
  TableParams params = test::default_table();
  AxisParams& axis = params.axis[GetParam()];
  axis.drive.hum_amplitude = 0.0;  // constant velocity
  axis.dac_bits = 40;
  axis.drive.velocity_gain_Hz =
      150.0;  // stiffer than the curve falls, or the slide sticks and slips
  const FrictionParams& f = axis.friction;
  const double fs = f.static_ratio * f.coulomb;
  const double mm_per_s_per_volt = axis.drive.vref_scale_rpm_per_V / 60.0 * axis.screw.lead;
  for (const double speed : {0.05, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 50.0, 150.0}) {
    for (const double v : {speed, -speed}) {
      DrivenAxis slide(params, GetParam());
      slide.command(v / mm_per_s_per_volt);
      const int settle = static_cast<int>((0.5 + 0.3 / speed) / kStep);  // 0.3 mm of sliding
      for (int k = 0; k < settle; ++k) {
        slide.step();
      }
      double force = 0.0;
      const int count = 500;
      for (int k = 0; k < count; ++k) {
        force += slide.step() / count;
      }
      ASSERT_NEAR(slide.velocity(), v, 1e-3 * speed);
      const double ratio = v / f.stribeck_velocity;
      const double expected =
          std::copysign(f.coulomb + (fs - f.coulomb) * std::exp(-ratio * ratio), v) + f.viscous * v;
      EXPECT_NEAR(force / expected, 1.0, 0.01) << v << " mm/s";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Axes, SteadySliding, ::testing::Values(kX, kY),
                         [](const auto& tested) { return tested.param == kX ? "X" : "Y"; });

}  // namespace stribeck_curve_test
}  // namespace twin::hal::mujoco
