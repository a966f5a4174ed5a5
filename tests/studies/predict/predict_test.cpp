#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gcode/reader.hpp"
#include "studies/compensate/contour_path.hpp"
#include "studies/predict/fastest.hpp"
#include "studies/predict/feed_program.hpp"
#include "studies/predict/tolerance.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::predict {
namespace predict_test {

using compensate::ContourPath;

config::MachineFile machine_file() {
  auto read = config::read_machine_file(TWIN_SOURCE_DIR "/mjcf/xy_table.toml");
  EXPECT_TRUE(read) << (read ? "" : to_string(read.error()));
  return read.value_or(config::MachineFile());
}

gcode::ProgramText corner() {
  return gcode::ProgramText::from_text("G01 X4 F2400\nY3\nG03 X0 Y3 R2\nG01 Y0\n", "corner.nc");
}

TEST(Uncertainty, DrawsTheSameMachinesWhateverTheOrder) {
  const auto uncertainty = Uncertainty::of(machine_file());
  ASSERT_TRUE(uncertainty);
  EXPECT_EQ(uncertainty->measured(), 0U);
  const PossibleMachine third = uncertainty->draw(1, 3);
  uncertainty->draw(1, 9);
  const PossibleMachine again = uncertainty->draw(1, 3);
  EXPECT_EQ(third.machine.table.axis[0].moving_mass, again.machine.table.axis[0].moving_mass);
  EXPECT_EQ(third.phases.hum, again.phases.hum);
  EXPECT_NE(third.machine.table.axis[0].moving_mass,
            uncertainty->draw(2, 3).machine.table.axis[0].moving_mass);
}

TEST(Uncertainty, DrawsHaveTheDeviationOfTheSettings) {
  const config::MachineFile machine = machine_file();
  const auto uncertainty = Uncertainty::of(machine);
  ASSERT_TRUE(uncertainty);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kDraws = 2000;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double x = uncertainty->draw(7, i).machine.table.axis[1].friction.coulomb /
                         machine.table.axis[1].friction.coulomb -
                     1.0;
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 0.01);
  EXPECT_NEAR(std::sqrt(squares / kDraws), machine.uncertainty.friction, 0.006);
}

TEST(Uncertainty, TakesDeviationsFromWhatIdentifyHasLeftBesideTheMachineFile) {
  const test::TempFolder folder;
  config::MachineFile machine = machine_file();
  machine.file = folder / "mine.toml";
  const auto json = [](const std::string& file) {
    return R"({"machine_file": ")" + file +
           R"(", "axis": {"x": {"parameters": [{"key": "table.x.moving_mass_kg", "sigma": 0.001,
              "verdict": "identified"}, {"key": "table.x.coulomb_friction_N", "sigma": 9,
              "verdict": "not shown"}]}, "y": null}})";
  };
  folder.put("identify.json", json("somewhere/mine.toml"));
  const auto measured = Uncertainty::of(machine);
  ASSERT_TRUE(measured) << to_string(measured.error());
  EXPECT_EQ(measured->measured(), 1U);
  EXPECT_EQ(measured->deviations()[0], 0.001);
  folder.put("identify.json", json("other.toml"));
  EXPECT_EQ(Uncertainty::of(machine)->measured(), 0U);
  folder.put("identify.json", R"({"machine_file": 1, "axis": {}})");  // was an exception
  EXPECT_EQ(Uncertainty::of(machine)->measured(), 0U);
  folder.put("identify.json", "[]");
  EXPECT_FALSE(Uncertainty::of(machine));
}

TEST(Tolerance, CountsAndBoundsTheProbability) {
  const std::vector<double> errors{0.001, 0.002, 0.003, 0.004,
                                   std::numeric_limits<double>::infinity()};
  const TolerancePrediction prediction = predict(errors, 0.003);
  EXPECT_EQ(prediction.within, 3U);
  EXPECT_DOUBLE_EQ(prediction.probability(), 0.6);
  // Wilson's interval of 3 in 5 [Wilson 1927].
  EXPECT_NEAR(prediction.low, 0.2307, 5e-4);
  EXPECT_NEAR(prediction.high, 0.8824, 5e-4);
  EXPECT_EQ(prediction.median, 0.003);
  EXPECT_TRUE(std::isinf(prediction.p95));
}

/// Probabilities that are promised for machines that are known up to some deviations, and how often
/// the true machine keeps the tolerance.
TEST(Tolerance, WhatIsPromisedIsMetOverRandomMachines) {
  const config::MachineFile nominal = machine_file();
  const auto of_nominal = Uncertainty::of(nominal);
  ASSERT_TRUE(of_nominal);
  const auto path = ContourPath::plan(corner(), nominal, std::nullopt);
  ASSERT_TRUE(path);
  double promised = 0.0;
  double variance = 0.0;
  int met = 0;
  const int machines =
      std::getenv("TWIN_COVERAGE") != nullptr ? std::atoi(std::getenv("TWIN_COVERAGE")) : 12;
  for (int i = 0; i < machines; ++i) {
    // The machine that is believed in, and a true one as far from it as is believed.
    const PossibleMachine believed = of_nominal->draw(11, static_cast<std::uint64_t>(i));
    const auto uncertainty = Uncertainty::of(believed.machine);
    ASSERT_TRUE(uncertainty);
    const PossibleMachine truth = uncertainty->draw(13, static_cast<std::uint64_t>(i));
    ToleranceOptions options;
    options.machines = 100;
    options.seed = 1000 + static_cast<std::uint64_t>(i);  // of its own: no common luck
    const auto errors = possible_errors(*path, *uncertainty, {}, {}, options);
    ASSERT_TRUE(errors);
    // Between two of the errors: one that is an error itself would be kept too seldom.
    const double share = 0.05 + 0.9 * ((i * 7) % 10) / 9.0;
    const double tolerance =
        0.5 * (quantile(errors->largest, share) + quantile(errors->largest, share + 0.01));
    const double p = predict(errors->largest, tolerance).probability();
    promised += p;
    variance += p * (1.0 - p);
    const auto run = compensate::run_model(truth.machine, path->points(), {}, truth.phases);
    met += compensate::stats_of(path->errors(run.table)).max <= tolerance ? 1 : 0;
  }
  RecordProperty("promised", std::to_string(promised));
  RecordProperty("met", met);
  EXPECT_NEAR(met, promised, 2.6 * std::sqrt(variance) + 0.5) << machines << " machines";
  if (machines > 100) {
    std::printf("%d machines: promised %.1f, met %d\n", machines, promised, met);
  }
}

TEST(Tolerance, AQuestionIsAnsweredAsByAllMachines) {
  const config::MachineFile machine = machine_file();
  const auto uncertainty = Uncertainty::of(machine);
  const auto path = ContourPath::plan(corner(), machine, std::nullopt);
  ASSERT_TRUE(uncertainty && path);
  ToleranceOptions options;
  options.machines = 30;
  const auto all = possible_errors(*path, *uncertainty, {}, {}, options);
  ASSERT_TRUE(all);
  for (const double share : {0.5, 0.9}) {
    const double edge = quantile(all->largest, share);
    for (const double tolerance : {0.99 * edge, edge}) {
      Question question(tolerance, share);
      options.question = &question;
      for (int i = 0; i < 2; ++i) {  // the second time the worst are tried first
        const auto some = possible_errors(*path, *uncertainty, {}, {}, options);
        ASSERT_TRUE(some);
        EXPECT_EQ(quantile(some->largest, share) <= tolerance, tolerance == edge);
      }
    }
  }
}

TEST(FeedProgram, MovesAsItsBlocksDo) {
  const auto text = gcode::ProgramText::from_text(
      "G01 X4 F2400\nG02 X6 Y2 I2 J0\nG00 Z5\nG04 P0.5\nG61\nG03 X2 Y2 Z4 R2\nG01 X0 Y0\n",
      "all.nc");
  gcode::Reader reader(text);
  std::vector<gcode::Block> blocks;
  for (auto block = reader.next(); block && *block; block = reader.next()) {
    blocks.push_back(**block);
  }
  ASSERT_EQ(blocks.size(), 6U);
  const std::vector<double> feeds{10.0, 20.0, 0.0, 0.0, 40.0, 50.0};
  const auto written = feed_program(blocks, feeds, machine_file(), "title");
  ASSERT_TRUE(written) << to_string(written.error());
  gcode::Reader again(gcode::ProgramText::from_text(*written, "written.nc"));
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto block = again.next();
    ASSERT_TRUE(block) << to_string(block.error());
    ASSERT_TRUE(*block);
    EXPECT_EQ((*block)->motion, blocks[i].motion) << i;
    EXPECT_LT(((*block)->end - blocks[i].end).norm(), 2e-6) << i;
    EXPECT_EQ((*block)->path_mode, blocks[i].path_mode) << i;
    if (feeds[i] > 0.0) {
      EXPECT_NEAR((*block)->feedrate, feeds[i], 1e-4) << i;
    }
    if (blocks[i].motion == gcode::Motion::kArc) {
      EXPECT_LT(((*block)->arc.centre - blocks[i].arc.centre).norm(), 2e-6);
      EXPECT_NEAR((*block)->arc.sweep, blocks[i].arc.sweep, 1e-5);
    }
  }
}

TEST(Fastest, KeepsTheToleranceOnMachinesThatTheSearchHasNotSeen) {
  FastestOptions options;
  options.machines = 12;
  options.verifying = 24;
  options.halvings = 2;
  options.rounds = 4;
  options.tolerance = 0.022;
  const auto found = fastest(corner(), machine_file(), options);
  ASSERT_TRUE(found) << to_string(found.error());
  ASSERT_TRUE(found->whole);
  EXPECT_GE(found->whole->verified.probability(), 0.8);
  ASSERT_TRUE(found->stretches);
  EXPECT_LE(found->stretches->time, found->whole->time + 1e-9);
  EXPECT_GE(found->stretches->verified.probability(), 0.8);
  // What is written is what was verified.
  const auto path = ContourPath::plan(gcode::ProgramText::from_text(found->program, "fastest.nc"),
                                      machine_file(), std::nullopt);
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->time(0.001), found->stretches->time, 1e-9);
}

TEST(Fastest, SaysWhereNoFeedrateKeepsTheTolerance) {
  FastestOptions options;
  options.machines = 2;
  options.verifying = 2;
  options.tolerance = 1e-5;
  const auto none =
      fastest(gcode::ProgramText::from_text("G01 X1 F2400\n", "short.nc"), machine_file(), options);
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->whole);
  EXPECT_NE(to_table(*none, options).find("none keeps the tolerance"), std::string::npos);
}

}  // namespace predict_test
}  // namespace twin::studies::predict
