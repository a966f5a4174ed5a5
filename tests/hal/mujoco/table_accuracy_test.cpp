#include <gtest/gtest.h>

#include <cmath>

#include "hal/mujoco/mujoco_machine.hpp"
#include "tests/support/position_loop.hpp"
#include "tests/support/table_files.hpp"

// The closed loop on the table as a whole.
namespace twin::hal::mujoco {
namespace table_accuracy_test {

using namespace test;  // NOLINT(google-build-using-namespace): helpers of this folder

constexpr double kPeriod = 1e-3;  // [s]

std::vector<Row> run_circle(const TableParams& params, const std::array<motion::Gains, 2>& g,
                            double radius, double speed, double duration, double period = kPeriod) {
  MujocoMachine machine(params);
  return run_loop(machine, g, period, duration,
                  [=](double t) { return on_circle(radius, smooth_start(t, speed, 0.2)); });
}

Spread contour(const std::vector<Row>& rows, double radius) {
  return spread(rows, 0, [=](const Row& row) { return circle_error(row, radius); });
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

}  // namespace table_accuracy_test
}  // namespace twin::hal::mujoco
