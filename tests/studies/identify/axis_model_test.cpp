#include "studies/identify/axis_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/mujoco/mujoco_machine.hpp"
#include "runtime/motion.hpp"
#include "studies/identify/table_run.hpp"
#include "tests/support/program_text.hpp"

namespace twin::studies::identify {
namespace axis_model_test {

config::MachineFile machine_file() {
  auto read = config::read_machine_file(TWIN_SOURCE_DIR "/mjcf/xy_table.toml");
  EXPECT_TRUE(read) << (read ? "" : to_string(read.error()));
  return read.value_or(config::MachineFile());
}

using Rows = std::array<std::vector<AxisRow>, hal::kServoAxes>;

/// The same run on the table of MuJoCo, by the period of runtime::Cycle.
Rows run_mujoco(const config::MachineFile& file, const std::vector<motion::SetPoint>& points) {
  hal::mujoco::MujocoMachine table(file.table);
  EXPECT_TRUE(checked(table.configure(file.period)));
  EXPECT_TRUE(checked(table.activate()));
  std::array<motion::AxisServo, 2> servos{
      motion::AxisServo{file.servo[0], table.info().mm_per_s_per_volt[0], file.period},
      motion::AxisServo{file.servo[1], table.info().mm_per_s_per_volt[1], file.period}};
  Rows rows;
  hal::Inputs inputs;
  hal::Outputs outputs;
  outputs.servo_on = {true, true};
  const long settle = std::lround(runtime::MotionOptions{}.rest_before / file.period);
  for (long k = -settle; k < static_cast<long>(points.size()); ++k) {
    EXPECT_EQ(table.read(inputs), hal::Status::kOk);
    const motion::SetPoint held;
    const motion::SetPoint& point = k < 0 ? held : points[static_cast<std::size_t>(k)];
    for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      const double measured =
          static_cast<double>(inputs.counts[axis]) * table.info().mm_per_count[axis];
      outputs.volts[axis] = servos[axis].update(
          {point.position[i], point.velocity[i], point.acceleration[i]}, measured);
      if (k >= 0) {
        rows[axis].push_back({measured, table.truth().table_position[axis], outputs.volts[axis]});
      }
    }
    EXPECT_EQ(table.write(outputs), hal::Status::kOk);
  }
  return rows;
}

std::vector<motion::Reference> references(const std::vector<motion::SetPoint>& points,
                                          Eigen::Index axis) {
  std::vector<motion::Reference> result;
  for (const motion::SetPoint& point : points) {
    result.push_back({point.position[axis], point.velocity[axis], point.acceleration[axis]});
  }
  return result;
}

/// Largest distance between two runs' table positions [mm].
double largest_difference(const std::vector<AxisRow>& a, const std::vector<AxisRow>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    largest = std::max(largest, std::abs(a[k].table - b[k].table));
  }
  return largest;
}

/// RMS tracking error of a run [mm].
double rms(const std::vector<AxisRow>& rows, const std::vector<motion::Reference>& set_points) {
  double sum = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    sum += std::pow(set_points[k].position - rows[k].encoder, 2);
  }
  return std::sqrt(sum / static_cast<double>(rows.size()));
}

TEST(AxisModel, IsTheTableOfMujocoSampleForSampleAndToHalfAPercentInRms) {
  const config::MachineFile file = machine_file();
  const auto points =
      plan_set_points(test::text_of(TWIN_SOURCE_DIR "/nc_programs/oxalis.nc"), file);
  ASSERT_TRUE(points) << to_string(points.error());
  const Rows mujoco = run_mujoco(file, *points);
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    const auto set_points = references(*points, static_cast<Eigen::Index>(axis));
    const std::vector<AxisRow> rows = simulate(axis_setup(file, axis), set_points).rows;
    const double error = rms(mujoco[axis], set_points);
    EXPECT_GT(error, 2e-3);
    EXPECT_NEAR(rms(rows, set_points), error, 0.005 * error);
    EXPECT_LT(largest_difference(rows, mujoco[axis]), 1e-9);
  }
}

/// The square on a table whose screws give, of both simulations: largest difference of table places.
double difference_with_screws(hal::mujoco::EncoderPlace place, double backlash) {
  config::MachineFile file = machine_file();
  file.table.model = TWIN_SOURCE_DIR "/mjcf/xy_table_compliant.xml";
  for (hal::mujoco::AxisParams& axis : file.table.axis) {
    axis.screw.stiffness = 20e3;
    axis.screw.backlash = backlash;
    axis.encoder.place = place;
    // A nut that is shaken in its play makes much of the last digit.
    axis.encoder.mm_per_count = 1e-6;
    axis.drive.hum_amplitude = 0.0;
  }
  const auto points =
      plan_set_points(test::text_of(TWIN_SOURCE_DIR "/nc_programs/square.nc"), file);
  EXPECT_TRUE(points) << to_string(points.error());
  const Rows mujoco = run_mujoco(file, *points);
  double largest = 0.0;
  for (const hal::Axis axis : {hal::kX, hal::kY}) {
    const auto set_points = references(*points, static_cast<Eigen::Index>(axis));
    const std::vector<AxisRow> rows = simulate(axis_setup(file, axis), set_points).rows;
    largest = std::max(largest, largest_difference(rows, mujoco[axis]));
    file.table.axis[axis].screw.backlash += 8e-3;
    EXPECT_GT(largest_difference(simulate(axis_setup(file, axis), set_points).rows, rows), 2e-3)
        << "play matters";
  }
  return largest;
}

TEST(AxisModel, WithAScrewThatGivesIsTheTableOfMujocoWhereverTheEncoderIs) {
  for (const auto place : {hal::mujoco::EncoderPlace::kMotor, hal::mujoco::EncoderPlace::kTable}) {
    // MuJoCo's rotors have 1e-10 kg m^2 more, of the body that a hinge needs.
    EXPECT_LT(difference_with_screws(place, 0.0), 2e-4);
    EXPECT_LT(difference_with_screws(place, 8e-3), 5e-4) << "with play";
  }
}

TEST(AxisModel, HumAndEncoderPhaseChangeTheRun) {
  config::MachineFile file = machine_file();
  const auto points =
      plan_set_points(test::text_of(TWIN_SOURCE_DIR "/nc_programs/square.nc"), file);
  ASSERT_TRUE(points) << to_string(points.error());
  const auto set_points = references(*points, 0);
  const std::vector<AxisRow> base = simulate(axis_setup(file, hal::kX), set_points).rows;
  file.table.axis[hal::kX].drive.hum_phase = 1.0;
  EXPECT_GT(largest_difference(base, simulate(axis_setup(file, hal::kX), set_points).rows), 1e-3);
  file.table.axis[hal::kX].drive.hum_phase = 0.0;
  file.table.axis[hal::kX].encoder.phase = 0.1;
  EXPECT_GT(largest_difference(base, simulate(axis_setup(file, hal::kX), set_points).rows), 1e-3);
}

TEST(AxisModel, RecordedVoltsRepeatTheRun) {
  const config::MachineFile file = machine_file();
  const auto points =
      plan_set_points(test::text_of(TWIN_SOURCE_DIR "/nc_programs/square.nc"), file);
  ASSERT_TRUE(points) << to_string(points.error());
  const AxisSetup setup = axis_setup(file, hal::kY);
  const std::vector<AxisRow> closed = simulate(setup, references(*points, 1)).rows;
  AxisModel model(setup);
  model.settle(0.0);
  for (const AxisRow& row : closed) {
    EXPECT_DOUBLE_EQ(model.drive(row.volts).table, row.table);
  }
}

TEST(AxisModel, AnUnstableLoopFailsAndStaysFinite) {
  AxisSetup setup = axis_setup(machine_file(), hal::kX);
  setup.axis.motor.peak_torque = 1e300;
  setup.axis.motor.current_lag = 0.0;
  setup.axis.drive.velocity_gain_Hz = 20000.0;
  std::vector<motion::Reference> set_points(2000);
  for (std::size_t k = 0; k < set_points.size(); ++k) {
    set_points[k].position = k < 10 ? 0.0 : 10.0;
  }
  const AxisRun run = simulate(setup, set_points);
  for (const AxisRow& row : run.rows) {
    EXPECT_TRUE(std::isfinite(row.table) && std::isfinite(row.encoder));
  }
  EXPECT_TRUE(run.has_failed);
}

TEST(Differentiate, IsExactWhereTheJerkIsConstant) {
  constexpr double kPeriod = 0.002;
  std::vector<double> positions;
  for (int k = 0; k < 20; ++k) {
    const double t = k * kPeriod;
    positions.push_back(1.0 + 2.0 * t + 250.0 * t * t + 5000.0 * t * t * t);
  }
  const auto set_points = differentiate(positions, kPeriod);
  for (std::size_t k = 2; k + 2 < positions.size(); ++k) {
    const double t = static_cast<double>(k) * kPeriod;
    EXPECT_EQ(set_points[k].position, positions[k]);
    EXPECT_NEAR(set_points[k].velocity, 2.0 + 500.0 * t + 15000.0 * t * t, 1e-9);
    EXPECT_NEAR(set_points[k].acceleration, 500.0 + 30000.0 * t, 1e-6);
  }
}

}  // namespace axis_model_test
}  // namespace twin::studies::identify
