#include "studies/compensate/compensate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hal/mujoco/mujoco_machine.hpp"
#include "results/metrics/limit_audit.hpp"
#include "runtime/correction_file.hpp"
#include "runtime/run.hpp"
#include "studies/compensate/learning.hpp"
#include "studies/compensate/model_run.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::compensate {
namespace compensate_test {

/// The table without hum and with counts of 1 um.
config::MachineFile clean_machine() {
  auto read = config::read_machine_file(TWIN_SOURCE_DIR "/mjcf/xy_table.toml");
  EXPECT_TRUE(read) << (read ? "" : to_string(read.error()));
  config::MachineFile machine = read.value_or(config::MachineFile());
  for (hal::mujoco::AxisParams& axis : machine.table.axis) {
    axis.drive.hum_amplitude = 0.0;
    axis.encoder.mm_per_count = 0.001;
  }
  return machine;
}

/// A corner, an arc with reversals of both axes, and the way back.
gcode::ProgramText program() {
  return gcode::ProgramText::from_text("G01 X10 F3000\nY6\nG03 X-2 Y6 R6\nG01 X0 Y0\n", "small.nc");
}

/// Moves MuJoCo's table, whose parameters may differ from what the controller knows.
runtime::RunResult move(const config::MachineFile& machine, const motion::Correction* correction,
                        const hal::mujoco::TableParams& table, TraceSink* sink = nullptr) {
  hal::mujoco::MujocoMachine hal(table);
  runtime::RunRequest request;
  request.program = program();
  request.machine = machine;
  request.hal = &hal;
  request.correction = correction;
  if (sink != nullptr) {
    request.sinks.push_back(sink);
  }
  auto result = runtime::run_program(request);
  EXPECT_TRUE(result) << (result ? "" : to_string(result.error()));
  return result ? *std::move(result) : runtime::RunResult();
}

TEST(Compensate, TheCorrectedTableMeetsThePathWithinTheLimitsOfTheMachine) {
  const config::MachineFile machine = clean_machine();
  const auto made = make_correction(program(), machine, {});
  ASSERT_TRUE(made) << to_string(made.error());
  const auto before = move(machine, nullptr, machine.table).summary;
  const auto after = move(machine, &made->correction, machine.table).summary;
  EXPECT_LT(after.run->table_contour_error.max, 0.35 * before.run->table_contour_error.max);
  EXPECT_LT(after.run->table_contour_error.rms, 0.2 * before.run->table_contour_error.rms);
  // The model's figures are those of the machine.
  EXPECT_NEAR(after.run->table_contour_error.rms, made->compensation.after.rms, 3e-4);
  const Limits& limits = machine.limits;
  EXPECT_LE(after.audit.feedrate, limits.feedrate);
  EXPECT_LE(after.audit.tangential_acceleration, limits.acceleration);
  EXPECT_LE(after.audit.tangential_jerk, limits.jerk);
  EXPECT_LE(after.audit.normal_acceleration, limits.acceleration);
  for (const Vec2& offset : made->correction.offsets) {
    EXPECT_LE(offset.lpNorm<Eigen::Infinity>(), machine.compensation.limit);
  }
}

TEST(Compensate, ATableThatDiffersIsLearntFromItsEncodersInThreeRuns) {
  const config::MachineFile machine = clean_machine();
  hal::mujoco::TableParams table = machine.table;
  for (hal::mujoco::AxisParams& axis : table.axis) {
    axis.moving_mass *= 1.2;
    axis.friction.coulomb *= 1.2;
    axis.friction.viscous *= 1.2;
    axis.drive.velocity_gain_Hz *= 0.8;
    axis.drive.integral_time *= 1.2;
  }
  auto made = make_correction(program(), machine, {});
  ASSERT_TRUE(made);
  const auto path =
      ContourPath::plan(program(), runtime::planned_with_reserve(machine), std::nullopt);
  ASSERT_TRUE(path);
  const double before = move(machine, nullptr, table).summary.run->table_contour_error.rms;
  Learnt learnt;
  std::array<double, 4> after{};
  for (double& rms : after) {
    MemoryTrace trace;
    rms = move(machine, &made->correction, table, &trace).summary.run->table_contour_error.rms;
    std::vector<Vec2> measured;
    for (std::size_t k = 0; k < trace.size(); ++k) {
      measured.emplace_back(trace["x_enc_mm"][k], trace["y_enc_mm"][k]);
    }
    ASSERT_TRUE(add_run(machine, *path, measured, made->correction.offsets, learnt));
    CompensateOptions options;
    options.mismatch = learnt.mismatch;
    made = make_correction(program(), machine, {}, options);
    ASSERT_TRUE(made);
  }
  EXPECT_LT(after[0], 0.4 * before);
  EXPECT_LT(after[3], 0.2 * before);
}

TEST(Compensate, ThePhasesOfEvenRunsFillTheirRangesAndAreNotThoseOfAnotherShift) {
  for (const std::size_t count : {2U, 8U, 20U}) {
    std::vector<double> encoder;
    for (std::size_t i = 0; i < count; ++i) {
      encoder.push_back(even_phases(i, count, 0.25).encoder[0]);
      EXPECT_NE(even_phases(i, count, 0.25).hum[0], even_phases(i, count, 0.0).hum[0]);
    }
    std::ranges::sort(encoder);
    for (std::size_t i = 1; i < count; ++i) {
      EXPECT_NEAR(encoder[i] - encoder[i - 1], 1.0 / static_cast<double>(count), 1e-12);
    }
  }
}

TEST(Compensate, AnAxisFollowsSlowOffsetsExactlyAndFastOnesHardly) {
  const std::vector<std::complex<double>> response = loop_response(clean_machine(), 0, 512);
  EXPECT_NEAR(std::abs(response[1] - 1.0), 0.0, 0.03);
  EXPECT_LT(std::abs(response[200]), 0.3);  // 391 Hz
}

TEST(Compensate, TheTransposeOfAFilterIsThat) {
  const Filter filter{{0.1, -0.4, 1.0, 0.7, 0.2}};
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> a(40);
  std::vector<double> b(40);
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = normal(random);
    b[i] = normal(random);
  }
  const std::vector<double> fa = filter.apply(a);
  const std::vector<double> fb = filter.apply_transposed(b);
  double left = 0.0;
  double right = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    left += fa[i] * b[i];
    right += a[i] * fb[i];
  }
  EXPECT_NEAR(left, right, 1e-12);
}

TEST(BandMatrix, SolvesWhatItMultiplied) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  BandMatrix matrix(30);
  std::vector<double> x(30);
  for (std::size_t i = 0; i < 30; ++i) {
    x[i] = normal(random);
    matrix.add(i, i, 20.0);
    for (std::size_t d = 1; d <= std::min<std::size_t>(BandMatrix::kBand, i); ++d) {
      matrix.add(i, i - d, normal(random));
    }
  }
  std::vector<double> b = matrix.times(x);
  matrix.factor();
  matrix.solve(b);
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_NEAR(b[i], x[i], 1e-12);
  }
}

/// A second of motion along x at 50 mm/s, while y stands.
std::vector<motion::SetPoint> straight_along_x() {
  std::vector<motion::SetPoint> points(1000);
  for (std::size_t k = 0; k < points.size(); ++k) {
    points[k].position.x() = 0.05 * static_cast<double>(k);
    points[k].velocity.x() = 50.0;
  }
  return points;
}

OffsetSolver solver_of(const std::vector<motion::SetPoint>& points) {
  return OffsetSolver(points, 0.001, {Filter{{1.0}}, Filter{{1.0}}}, {80.0, 80.0});
}

std::vector<Vec2> offsets_against(const OffsetSolver& solver, double hz, std::size_t periods) {
  std::vector<Vec2> errors(periods);
  for (std::size_t k = 0; k < periods; ++k) {
    errors[k] = {0.0,
                 0.002 * std::cos(2.0 * std::numbers::pi * hz * 0.001 * static_cast<double>(k))};
  }
  std::vector<Vec2> offsets(periods, Vec2::Zero());
  solver.improve(errors, offsets);
  return offsets;
}

TEST(OffsetSolver, AnAxisThatStandsWasDrivenToAndFroByQuickOffsets) {
  const auto points = straight_along_x();
  const OffsetSolver solver = solver_of(points);
  const auto lasting = offsets_against(solver, 0.0, points.size());
  const auto quick = offsets_against(solver, 10.0, points.size());
  EXPECT_NEAR(lasting[500].y(), 0.002, 1e-5);
  EXPECT_LT(std::abs(quick[500].y()), 0.0002);
}

TEST(OffsetSolver, WeightsThatHeldEarlierOffsetsWereNeverLowered) {
  const auto points = straight_along_x();
  const OffsetSolver fresh = solver_of(points);
  OffsetSolver held = solver_of(points);
  const std::vector<double> factors(points.size(), 100.0);
  held.hold(factors, factors);
  std::vector<Vec2> errors(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    errors[k] = {0.0, std::abs(static_cast<double>(k) - 500.0) < 100.0 ? 0.002 : 0.0};
  }
  const auto largest_difference = [&] {
    std::vector<Vec2> a(points.size(), Vec2::Zero());
    std::vector<Vec2> b = a;
    fresh.improve(errors, a);
    held.improve(errors, b);
    double largest = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      largest = std::max(largest, (a[k] - b[k]).norm());
    }
    return largest;
  };
  const double before = largest_difference();
  for (int i = 0; i < 12; ++i) {
    held.relax();
  }
  EXPECT_LT(largest_difference(), 0.01 * before);
}

TEST(OffsetAudit, MendsOffsetsThatExceedTheJerkAndLeavesOthersAlone) {
  const config::MachineFile machine = clean_machine();
  const auto path =
      ContourPath::plan(program(), runtime::planned_with_reserve(machine), std::nullopt);
  ASSERT_TRUE(path);
  const OffsetAudit audit(path->points(), {machine.limits, 0.05, machine.period});
  std::vector<Vec2> gentle(path->points().size(), Vec2(0.003, -0.002));
  EXPECT_TRUE(audit.mend(gentle));
  EXPECT_EQ(gentle[100], Vec2(0.003, -0.002));
  std::vector<Vec2> rough(path->points().size());
  for (std::size_t k = 0; k < rough.size(); ++k) {
    rough[k] = Vec2(0.01 * std::sin(0.4 * static_cast<double>(k)), 0.2);
  }
  static_cast<void>(audit.mend(rough));
  results::LimitAudit found(machine.period, machine.limits);
  for (std::size_t k = 0; k < rough.size(); ++k) {
    Vec3 point = path->points()[k].position;
    point.head<2>() += rough[k];
    found.add(point);
    EXPECT_LE(rough[k].lpNorm<Eigen::Infinity>(), 0.05);
  }
  EXPECT_LE(found.finish().tangential_jerk, machine.limits.jerk);
}

TEST(Compensate, ATableThatWasNeverIdentifiedIsRefused) {
  config::MachineFile machine = clean_machine();
  machine.table.is_identified = false;
  const auto made = make_correction(program(), machine, {});
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("never identified"), std::string::npos);
}

TEST(Compensate, ARunTooShortToLearnFromIsRefused) {
  const config::MachineFile machine = clean_machine();
  const auto path = ContourPath::plan(gcode::ProgramText::from_text("G01 X0.05 F600\n", "tiny.nc"),
                                      machine, std::nullopt);
  ASSERT_TRUE(path);
  const std::vector<Vec2> none(path->points().size(), Vec2::Zero());
  Learnt learnt;
  const auto added = add_run(machine, *path, none, none, learnt);
  ASSERT_FALSE(added);
  EXPECT_NE(added.error().message.find("least to learn from"), std::string::npos);
  EXPECT_FALSE(add_run(machine, *path, std::span(none).first(5), none, learnt));
}

TEST(CorrectionFile, IsReadBackAsWrittenAndRefusedForAnythingElse) {
  const test::TempFolder folder;
  const config::MachineFile machine = clean_machine();
  const motion::Correction correction{{{0.0, 0.0, 0.0}, {0.1, 1.0 / 3.0, -2.0}},
                                      {{0.001, -0.02}, {1e-7, 0.0123456789}}};
  const auto origin = runtime::correction_origin(program(), machine, 50.0);
  const auto file = folder / "c.csv";
  ASSERT_TRUE(runtime::write_correction(file, correction, origin, "remark"));
  const auto back = runtime::read_correction(file, origin, 0.05);
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_EQ(back->points, correction.points);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR((back->offsets[k] - correction.offsets[k]).norm(), 0.0, 1e-15);
  }
  const auto refusal = [&](const runtime::CorrectionOrigin& wanted, double limit) {
    const auto read = runtime::read_correction(file, wanted, limit);
    return read ? std::string("none") : to_string(read.error());
  };
  config::MachineFile other = machine;
  other.servo[0].kp *= 1.01;
  EXPECT_NE(
      refusal(runtime::correction_origin(program(), other, 50.0), 0.05).find("other settings"),
      std::string::npos);
  const auto another = gcode::ProgramText::from_text("G01 X1 F600\n", "other.nc");
  EXPECT_NE(
      refusal(runtime::correction_origin(another, machine, 50.0), 0.05).find("another program"),
      std::string::npos);
  EXPECT_NE(refusal(runtime::correction_origin(program(), machine, {}), 0.05).find("feedrate"),
            std::string::npos);
  runtime::CorrectionOrigin slower = origin;
  slower.period = 0.002;
  EXPECT_NE(refusal(slower, 0.05).find("period"), std::string::npos);
  EXPECT_NE(refusal(origin, 0.01).find("beyond compensation.limit_mm"), std::string::npos);
  // Neither rig nor phases are a part of the machine that a correction is made for.
  other = machine;
  other.table.axis[0].drive.hum_phase = 1.0;
  other.table.axis[1].encoder.phase = 0.1;
  EXPECT_EQ(refusal(runtime::correction_origin(program(), other, 50.0), 0.05), "none");
}

TEST(CorrectionFile, BrokenTextsAreErrorsWithALine) {
  const test::TempFolder folder;
  const auto origin = runtime::correction_origin(program(), clean_machine(), {});
  const motion::Correction correction{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, {{0.0, 0.0}, {0.0, 0.0}}};
  const auto file = folder / "c.csv";
  ASSERT_TRUE(runtime::write_correction(file, correction, origin, "remark"));
  const std::string sound = *read_whole_file(file);
  const auto error_of = [&](const std::string& text) {
    EXPECT_TRUE(write_whole_file(file, text));
    const auto read = runtime::read_correction(file, origin, 0.05);
    return read ? Error{ErrorCode::kFile, "none", {}, 0, 0} : read.error();
  };
  EXPECT_EQ(error_of("").message.substr(0, 23), "this is no correction: ");
  EXPECT_EQ(error_of("t_s,x\n0,1\n").line, 1);
  EXPECT_EQ(error_of(sound + "1,2,3\n").line, 13);
  EXPECT_EQ(error_of(sound + "1,2,3,4,nan\n").line, 13);
  EXPECT_EQ(error_of(sound + "1,2,3,4,5,6\n").line, 13);
  EXPECT_NE(error_of(sound.substr(0, sound.size() - 10)).message, "none");
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    std::string text = sound;
    text[random() % text.size()] = static_cast<char>(random() % 256);
    error_of(text);  // whatever it says, it neither crashes nor hangs
  }
}

}  // namespace compensate_test
}  // namespace twin::studies::compensate
