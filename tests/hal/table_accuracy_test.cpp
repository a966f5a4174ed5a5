#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hal/mujoco/mujoco_machine.hpp"
#include "tests/hal/position_loop.hpp"
#include "tests/hal/table_files.hpp"

// The closed loop on the table as a whole.
namespace twin::hal {
namespace {

using namespace testing;  // NOLINT(google-build-using-namespace): helpers of this folder

constexpr double kPeriod = 1e-3;  // [s]

std::vector<Row> run_circle(const TableParams& params, const std::array<servo::Gains, 2>& g,
                            double radius, double speed, double duration, double period = kPeriod) {
  MujocoMachine machine(params);
  return run_loop(machine, g, period, duration,
                  [=](double t) { return on_circle(radius, smooth_start(t, speed, 0.2)); });
}

Spread contour(const std::vector<Row>& rows, double radius) {
  return spread(rows, 0, [=](const Row& row) { return circle_error(row, radius); });
}

// Eq. 3: kappa eps = 1 - sqrt((Kf^2 w^2 + Kp^2) / (w^2 + Kp^2)). It holds for a velocity loop
// without lag and a controller without sampling; both are made small here against 1 / Kp.
TEST(TableAccuracy, RadialErrorOnACircleIsThatOfEquationThreeWithinOnePercent) {
  TableParams params = faultless_table();
  params.physics_step = 0.0125e-3;
  for (AxisParams& axis : params.axis) {
    axis.drive.velocity_gain_Hz = 8000.0;
    axis.drive.integral_time = 10.0;
  }
  const double radius = 10.0;
  const double speed = 50.0;
  const double w = speed / radius;
  for (const double kp : {20.0, 30.0}) {
    for (const double kf : {0.0, 0.34}) {
      const auto rows = run_circle(params, {gains(kp, kf, 0.0), gains(kp, kf, 0.0)}, radius, speed,
                                   2.5, 0.125e-3);
      double mean = 0.0;
      const std::size_t turn = static_cast<std::size_t>(2.0 * std::numbers::pi / w / 0.125e-3);
      for (std::size_t i = rows.size() - turn; i < rows.size(); ++i) {
        mean -= circle_error(rows[i], radius) / static_cast<double>(turn);
      }
      const double expected =
          radius * (1.0 - std::sqrt((kf * kf * w * w + kp * kp) / (w * w + kp * kp)));
      EXPECT_NEAR(mean / expected, 1.0, 0.01) << "Kp " << kp << ", Kf " << kf;
    }
  }
}

TEST(TableAccuracy, CircleStaysWithinThePublishedErrorsAtThreeThousandMmPerMin) {
  const Spread error = contour(run_circle(default_table(), default_gains(), 20.0, 50.0, 3.0), 20.0);
  EXPECT_LT(error.rms, 10e-3);
  EXPECT_LT(error.max, 40e-3);
  EXPECT_GT(error.rms, 2e-3) << "the floor of counts and hum is gone";
}

TEST(TableAccuracy, TightRoundStaysWithinThePublishedErrors) {
  const Spread error = contour(run_circle(default_table(), default_gains(), 1.0, 22.0, 2.0), 1.0);
  EXPECT_LT(error.rms, 15e-3);
  EXPECT_LT(error.max, 40e-3);
}

TEST(TableAccuracy, WithoutItsFaultsTheTableIsTenTimesBetter) {
  const auto g = gains(150.0, 1.0, 0.55e-3);
  for (const auto& [radius, speed] : {std::pair{20.0, 50.0}, std::pair{1.0, 22.0}}) {
    const Spread error = contour(run_circle(faultless_table(), {g, g}, radius, speed, 2.0), radius);
    EXPECT_LT(error.rms, 1e-3);
    EXPECT_LT(error.max, 4e-3);
  }
}

TEST(TableAccuracy, HalvingThePhysicsStepChangesTheRmsByUnderOnePercent) {
  TableParams params = default_table();
  const double coarse = contour(run_circle(params, default_gains(), 20.0, 50.0, 10.0), 20.0).rms;
  params.physics_step *= 0.5;
  const double fine = contour(run_circle(params, default_gains(), 20.0, 50.0, 10.0), 20.0).rms;
  EXPECT_NEAR(coarse / fine, 1.0, 0.01);
}

TEST(TableAccuracy, TwoRunsGiveTheSameBytes) {
  const auto first = run_circle(default_table(), default_gains(), 20.0, 50.0, 1.0);
  const auto second = run_circle(default_table(), default_gains(), 20.0, 50.0, 1.0);
  EXPECT_EQ(first, second);
}

TEST(TableAccuracy, ScrewThatGivesDrivesTheTableOffTheEncoderButNotFar) {
  TableParams params = default_table();
  params.model = mjcf_file("xy_table_compliant.xml");
  const auto rows = run_circle(params, default_gains(), 1.0, 22.0, 1.0);
  const auto off = [](const Row& row) { return row.table[0] - row.encoder[0]; };
  const auto rigid = run_circle(default_table(), default_gains(), 1.0, 22.0, 1.0);
  // 12 kg at 484 mm/s^2 and 12 N of friction stretch 60 N/um by 0.3 um; the encoder rounds to +-5
  // um.
  EXPECT_LT(spread(rows, 0, off).max, 6e-3);
  EXPECT_NEAR(contour(rows, 1.0).rms / contour(rigid, 1.0).rms, 1.0, 0.05);
}

}  // namespace
}  // namespace twin::hal
