#include "studies/reproduce/table_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/mujoco/mujoco_machine.hpp"
#include "runtime/run.hpp"
#include "studies/identify/table_run.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::reproduce {
namespace table_fit_test {

config::MachineFile machine_file() {
  auto read = config::read_machine_file(TWIN_SOURCE_DIR "/mjcf/xy_table.toml");
  EXPECT_TRUE(read) << (read ? "" : to_string(read.error()));
  return read.value_or(config::MachineFile());
}

TEST(TableFit, CostIsNothingWhereAFigureIsMetAndBoundedWhereItIsFarOff) {
  for (const auto& cost : {smooth_cost, share_cost}) {
    EXPECT_NEAR(cost(5.6, 5.6), 0.0, 1e-3);
    EXPECT_LT(cost(56.0, 5.6), 2.5);
    EXPECT_GT(cost(56.0, 5.6), 1.0);
    EXPECT_FALSE(std::isfinite(cost(INFINITY, 5.6)));
  }
  EXPECT_DOUBLE_EQ(smooth_cost(2.0, 5.0), smooth_cost(5.0, 2.0));
}

TEST(TableFit, ShareCostRisesWhereTheCountingSharesAre) {
  EXPECT_GT(share_cost(1.21, 1.0) - share_cost(1.17, 1.0), 0.4);
  EXPECT_GT(share_cost(1.31, 1.0) - share_cost(1.26, 1.0), 0.3);
  EXPECT_LT(share_cost(1.12, 1.0), 0.15);
}

TEST(TableRun, HasTheErrorsOfARunOnTheTableOfMujoco) {
  const test::TempFolder folder;
  runtime::RunRequest request;
  request.program = test::text_of(TWIN_SOURCE_DIR "/nc_programs/oxalis.nc");
  request.machine = machine_file();
  request.machine.path.planner = Planner::kPaper;
  hal::mujoco::MujocoMachine table(request.machine.table);
  request.hal = &table;
  request.directory = folder / "out";
  const auto run = runtime::run_program(request);
  ASSERT_TRUE(run && run->summary.run);
  const auto planned = studies::identify::TableRun::plan(request.program, request.machine);
  ASSERT_TRUE(planned);
  const studies::identify::RunErrors errors = planned->run(request.machine);
  const results::MachineResults& judge = *run->summary.run;
  EXPECT_NEAR(planned->machining_time(), judge.machining_time, 1e-9);
  EXPECT_NEAR(errors.contour_rms, judge.contour_error.rms, 0.005 * judge.contour_error.rms);
  EXPECT_NEAR(errors.contour_max, judge.contour_error.max, 0.05 * judge.contour_error.max);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const results::ErrorStats& tracking = judge.tracking_error[axis];
    EXPECT_NEAR(errors.axis_rms[axis], tracking.rms, 0.005 * tracking.rms);
    EXPECT_NEAR(errors.axis_max[axis], tracking.max, 0.05 * tracking.max);
  }
}

/// The published data with one measured row alone.
Published one_row() {
  auto all = published();
  EXPECT_TRUE(all);
  Published one = *all;
  std::erase_if(one.rows, [](const PublishedRow& row) {
    return row.table != 4 || row.feedrate_mm_per_min != 3000.0 || row.interpolator != "nurbs";
  });
  EXPECT_EQ(one.rows.size(), 1U);
  return one;
}

TEST(TableFit, FindsASetThatFitsARowBetterThanAPoorStart) {
  config::MachineFile start = machine_file();
  for (hal::mujoco::AxisParams& axis : start.table.axis) {
    axis.drive.hum_amplitude = 60e-3;
  }
  start.planning = PlanningModel{};
  start.planning.kp = 313.95 * 0.5;
  start.planning.kf = 0.5;
  TableFitOptions options;
  options.evaluations = 120;
  const auto fit = fit_tables(one_row(), start, options);
  ASSERT_TRUE(fit) << (fit ? "" : to_string(fit.error()));
  EXPECT_LT(fit->cost_after, 0.7 * fit->cost_before);
  EXPECT_LT(fit->time_error, 0.005);
  EXPECT_NEAR(fit->machine.planning.kp / (1.0 - fit->machine.planning.kf), 313.95, 1e-6);
  EXPECT_LT(fit->machine.planning.kf, 0.4);
}

TEST(TableFit, StopsWithTheBestSoFar) {
  std::atomic<bool> stop{false};
  TableFitOptions options;
  options.stop = &stop;
  options.progress = [&stop](double, double) { stop = true; };
  const config::MachineFile start = machine_file();
  const auto fit = fit_tables(one_row(), start, options);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->was_stopped);
  EXPECT_LE(fit->cost_after, fit->cost_before + 1e-9);
}

TEST(TableFit, StoppedBeforeThereIsABestIsInterrupted) {
  const std::atomic<bool> stop{true};
  TableFitOptions options;
  options.stop = &stop;
  const auto fit = fit_tables(one_row(), machine_file(), options);
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().code, ErrorCode::kInterrupted);
}

}  // namespace table_fit_test
}  // namespace twin::studies::reproduce
