#include "tests/support/loop_fixture.hpp"

// Whole programs on the table: what they report must not hang on how finely time is cut.
namespace twin {
namespace physics_step_test {

class PhysicsStep : public test::LoopTest, public ::testing::WithParamInterface<const char*> {
 protected:
  results::MachineResults run_with(double share_of_step) const {
    config::MachineFile file = machine();
    file.table.physics_step *= share_of_step;
    hal::mujoco::MujocoMachine table(file.table);
    return execute(program(GetParam()), file, &table, std::nullopt)
        .run.value_or(results::MachineResults());
  }
};

TEST_P(PhysicsStep, HalvedChangesNoRmsByOneAndAHalfPercent) {
  const results::MachineResults coarse = run_with(1.0);
  const results::MachineResults fine = run_with(0.5);
  ASSERT_GT(fine.contour_error.rms, 0.0);
  EXPECT_NEAR(coarse.contour_error.rms / fine.contour_error.rms, 1.0, 0.015);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(coarse.tracking_error[axis].rms / fine.tracking_error[axis].rms, 1.0, 0.015);
  }
}

INSTANTIATE_TEST_SUITE_P(Programs, PhysicsStep, ::testing::Values("dolphin.nc", "oxalis.nc"),
                         [](const auto& tested) {
                           const std::string name = tested.param;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace physics_step_test
}  // namespace twin
