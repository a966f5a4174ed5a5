#include "studies/tune/tune.hpp"

#include <gmock/gmock.h>

#include "studies/tune/tune_report.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::tune {
namespace tune_test {

using testing::HasSubstr;

/// A short path with a corner and an arc, and the gains of one axis.
struct TuneSetup {
  test::TempFolder folder;
  Task task;

  TuneSetup() {
    const auto program = folder.path() / "short.nc";
    test::put(program, "G21 G90\nG1 X4 F3000\nY3\nG3 X1 Y6 I-3 J0\nG0 X0 Y0\nM30\n");
    task.programs = {program.string()};
    task.settings = {"servo.x.kp_per_s=150"};  // with the margins of 6 dB and 30 deg
    task.keys = {{"servo.y.kp_per_s", 40.0, 300.0, true}, {"servo.y.kf", 0.7, 1.2, false}};
  }
  Expected<Tuning> run(const char* store, std::size_t trials, unsigned workers) {
    return tune(task, *batch::Store::open(folder.path() / store),
                {.trials = trials, .workers = workers});
  }
};

TEST(Tune, ItIsNeverWorseThanTheStartAndKeepsTheMargins) {
  TuneSetup setup;
  const auto tuning = setup.run("store", 24, 0);
  ASSERT_TRUE(tuning) << to_string(tuning.error());
  EXPECT_LT(tuning->best.merit.contour_error, tuning->before.merit.contour_error);
  for (const config::LoopMargins& loop : tuning->best.loops) {
    EXPECT_GE(loop.gain_margin, 1.995);  // 6 dB
    EXPECT_GE(loop.phase_margin_deg, 30.0);
  }
  for (const Trial& trial : tuning->trials) {
    EXPECT_GE(trial.merit.contour_error, tuning->best.merit.contour_error);
  }
  EXPECT_EQ(tuning->judgements.size(), 3U);
}

TEST(Tune, TheSameOnAnyNumberOfCoresAndFromTheStore) {
  TuneSetup setup;
  const auto one = setup.run("a", 14, 1);
  const auto three = setup.run("b", 14, 3);
  const auto again = setup.run("b", 14, 2);
  ASSERT_TRUE(one && three && again);
  EXPECT_EQ(to_json(setup.task, *one), to_json(setup.task, *three));
  EXPECT_EQ(to_json(setup.task, *three), to_json(setup.task, *again));
  EXPECT_EQ(again->computed, 0U);
}

TEST(Tune, MoreTrialsGoOnWhereFewerEnded) {
  TuneSetup setup;
  ASSERT_TRUE(setup.run("store", 7, 0));
  const auto more = setup.run("store", 14, 0);
  ASSERT_TRUE(more);
  EXPECT_GE(more->found, 7U);
}

TEST(Tune, TimeIsLeastWithinTheContourError) {
  TuneSetup setup;
  setup.task.aim = Aim::kTime;
  setup.task.largest_error = 60.0;
  setup.task.keys = {{"limits.jerk_mm_per_s3", 10000.0, 200000.0, true}};
  const auto tuning = setup.run("store", 20, 0);
  ASSERT_TRUE(tuning) << to_string(tuning.error());
  EXPECT_LE(tuning->best.merit.contour_error, 60.0);
  EXPECT_LT(tuning->best.merit.time, tuning->before.merit.time);
}

TEST(Tune, WhereNoSettingsHaveTheMarginsItIsSaid) {
  TuneSetup setup;
  setup.task.margins = {.gain_dB = 60.0, .phase_deg = 30.0};
  const auto tuning = setup.run("store", 7, 0);
  ASSERT_FALSE(tuning);
  EXPECT_THAT(tuning.error().message, HasSubstr("gain margin of 60 dB"));
  setup.task.margins = {.gain_dB = 6.0, .phase_deg = 30.0};
  setup.task.aim = Aim::kTime;
  setup.task.largest_error = 0.01;
  EXPECT_THAT(setup.run("store", 7, 0).error().message,
              HasSubstr("no settings keep the contour error of 0.01 um"));
  setup.task.programs.push_back("no_such.nc");
  EXPECT_THAT(setup.run("store", 7, 0).error().message, HasSubstr("no such NC program"));
}

TEST(Tune, WrongKeysAreNamed) {
  TuneSetup setup;
  setup.task.keys = {{"servo.y.kp_per_m", 1.0, 2.0, false}};
  EXPECT_THAT(setup.run("s", 5, 0).error().message, HasSubstr("servo.y.kp_per_s"));
  setup.task.keys = {{"servo.y.kp_per_s", -5.0, 2.0, false}};
  EXPECT_FALSE(setup.run("s", 5, 0));
  setup.task.keys = {{"planning.planner", 1.0, 2.0, false}};
  EXPECT_THAT(setup.run("s", 5, 0).error().message, HasSubstr("no real number"));
}

TEST(VariedKey, RangesAreRead) {
  const auto key = parse_varied_key("servo.x.kp_per_s=100:400:log");
  ASSERT_TRUE(key);
  EXPECT_DOUBLE_EQ(key->value(0.5), 200.0);
  EXPECT_DOUBLE_EQ(key->place(400.0), 1.0);
  for (const char* wrong : {"a", "a=1", "a=1:", "a=2:1", "a=0:1:log", "=1:2", "a=1:x", "a=1:inf"}) {
    EXPECT_THAT(parse_varied_key(wrong).error().message, HasSubstr("--vary")) << wrong;
  }
}

}  // namespace tune_test
}  // namespace twin::studies::tune
