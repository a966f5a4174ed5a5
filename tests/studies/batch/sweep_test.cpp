#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <set>

#include "studies/batch/results_table.hpp"
#include "studies/batch/samples.hpp"
#include "studies/batch/sweep_file.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::batch {
namespace sweep_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Samples, ALatinHypercubeHasOnePointInEveryInterval) {
  constexpr std::size_t kCount = 50;
  const auto points = latin_hypercube(kCount, 3, 7);
  for (std::size_t k = 0; k < 3; ++k) {
    std::set<int> intervals;
    for (const auto& point : points) {
      intervals.insert(static_cast<int>(point[k] * kCount));
    }
    EXPECT_EQ(intervals.size(), kCount);
  }
  EXPECT_EQ(points, latin_hypercube(kCount, 3, 7));
  EXPECT_NE(points, latin_hypercube(kCount, 3, 8));
}

TEST(Samples, TheQuantileIsTheInverseOfTheDistribution) {
  for (const double p : {1e-12, 1e-5, 0.02, 0.3, 0.5, 0.7, 0.999}) {
    const double x = normal_quantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-x / std::numbers::sqrt2), p, 1e-12 * p + 1e-16) << p;
  }
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-12);  // of any table
}

TEST(Samples, NormalOnesHaveMeanZeroAndDeviationOne) {
  constexpr std::size_t kCount = 20000;
  double sum = 0.0;
  double squares = 0.0;
  for (const auto& point : normal_samples(kCount, 1, 1)) {
    sum += point[0];
    squares += point[0] * point[0];
  }
  EXPECT_NEAR(sum / kCount, 0.0, 4.0 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1.0, 4.0 * std::sqrt(2.0 / kCount));
}

constexpr const char* kSweep = R"(
program = ["a.nc", "b.nc"]
feedrate_mm_per_min = 3000
machine = "m.toml"
hal = "ideal"
[set]
"servo.x.kd" = 0.5
"limits.axis_jerk" = [1, 2, 3]
[grid]
"servo.x.kp" = [100, 200.5]
"servo.y.kp" = { from = 1, to = 3, count = 3 }
[latin_hypercube]
count = 4
"servo.x.kf" = { from = 0.9, to = 1.1 }
)";

TEST(Sweep, EveryCombinationIsAJob) {
  const auto sweep = parse_sweep(kSweep, "s.toml");
  ASSERT_TRUE(sweep) << to_string(sweep.error());
  EXPECT_THAT(keys_of(*sweep), ElementsAre("program", "feedrate_mm_per_min", "servo.x.kp",
                                           "servo.y.kp", "servo.x.kf"));
  const auto points = points_of(*sweep);
  ASSERT_TRUE(points);
  ASSERT_EQ(points->size(), 2U * 1U * 2U * 3U * 4U);
  const Job& last = points->back().job;
  EXPECT_EQ(last.program, "b.nc");
  EXPECT_DOUBLE_EQ(*last.feedrate, 50.0);
  EXPECT_EQ(last.machine, "m.toml");
  EXPECT_THAT(last.settings,
              ::testing::IsSupersetOf({"servo.x.kd=0.5", "limits.axis_jerk=[1, 2, 3]",
                                       "servo.x.kp=200.5", "servo.y.kp=3"}));
}

TEST(Sweep, MonteCarloDrawsWhatWasIdentified) {
  const test::TempFolder folder;
  test::put(folder.path() / "identify.json", R"({"x": {"parameters": [
    {"key": "table.x.coulomb_friction_N", "value": 1.8, "sigma": 0.1, "verdict": "identified"},
    {"key": "table.x.moving_mass_kg", "value": 12, "sigma": 0, "verdict": "not shown"},
    {"key": "servo.x.kp_per_s", "value": 300, "sigma": null, "verdict": "measured"}],
    "derived": [{"key": "a", "value": 1, "sigma": 1, "verdict": "identified"}]},
    "y": {"parameters": [
    {"key": "table.y.coulomb_friction_N", "value": 4, "sigma": 0.5, "verdict": "uncertain"}]}})");
  const auto file = folder.path() / "s.toml";
  const auto sweep = parse_sweep(
      "program = \"a.nc\"\n[monte_carlo]\ncount = 5\nidentified = \"identify.json\"\n", file);
  ASSERT_TRUE(sweep) << to_string(sweep.error());
  EXPECT_THAT(keys_of(*sweep),
              ElementsAre("program", "table.x.coulomb_friction_N", "table.y.coulomb_friction_N"));
  EXPECT_DOUBLE_EQ(sweep->normal[1].from, 4.0);
  EXPECT_DOUBLE_EQ(sweep->normal[1].to, 0.5);
  EXPECT_EQ(points_of(*sweep)->size(), 5U);
  for (const char* text : {"{}", "not JSON", "[1, 2]"}) {
    test::put(folder.path() / "identify.json", text);
    const auto wrong = parse_sweep(
        "program = \"a.nc\"\n[monte_carlo]\ncount = 5\nidentified = \"identify.json\"\n", file);
    ASSERT_FALSE(wrong);
    EXPECT_THAT(to_string(wrong.error()), HasSubstr("s.toml:4:")) << text;
  }
}

TEST(Sweep, WhatIsWrongIsSaidWithLineAndColumn) {
  const std::vector<std::pair<const char*, const char*>> wrong{
      {"program = ", "s.toml:1:"},
      {"hal = \"ideal\"", "there is no program"},
      {"program = \"a.nc\"\ngird = 1", "s.toml:2:8: unknown key gird; did you mean grid?"},
      {"program = \"a.nc\"\nhal = \"rig\"", "expected mujoco, ideal or none"},
      {"program = \"a.nc\"\n[grid]\nx = []", "s.toml:3:5: an empty list"},
      {"program = \"a.nc\"\n[grid]\nx = { from = 1 }", "count = 2 OR MORE"},
      {"program = \"a.nc\"\n[latin_hypercube]\nx = { from = 1, to = 2 }", "count is missing"},
      {"program = \"a.nc\"\n[monte_carlo]\ncount = 3\nx = { mean = 1 }", "sigma = NUMBER"},
      {"program = \"a.nc\"\nfeedrate_mm_per_min = [100, 0]", "above 0"}};
  for (const auto& [text, expected] : wrong) {
    const auto sweep = parse_sweep(text, "s.toml");
    ASSERT_FALSE(sweep) << text;
    EXPECT_THAT(to_string(sweep.error()), HasSubstr(expected)) << text;
  }
}

TEST(Sweep, AFolderInPlaceOfAFileIsRefused) {
  const test::TempFolder folder;
  const auto sweep = read_sweep(folder.path());
  ASSERT_FALSE(sweep);
  EXPECT_THAT(sweep.error().message, HasSubstr("cannot read"));
}

TEST(Sweep, TooManyJobsAreRefusedBeforeTheyAreMade) {
  const auto sweep = parse_sweep(
      "program = \"a.nc\"\n[grid]\na = { from = 1, to = 2, count = 1000 }\n"
      "b = { from = 1, to = 2, count = 1000 }\nc = { from = 1, to = 2, count = 1000 }\n",
      "s.toml");
  ASSERT_TRUE(sweep);
  const auto points = points_of(*sweep);
  ASSERT_FALSE(points);
  EXPECT_THAT(points.error().message, HasSubstr("1e+09 jobs"));
}

/// A row of a table.
Row row_of(std::vector<std::string> values, double time, double error) {
  Row row;
  row.point.values = std::move(values);
  row.result.summary = "{\"machining_time_s\": " + std::to_string(time) +
                       ", \"contour_error_um\": {\"max\": " + std::to_string(error) + "}}";
  return row;
}

TEST(Pareto, TheFrontHasWhatNoOtherIsBetterThan) {
  const std::vector<std::string> keys{"program", "kp"};
  std::vector<Row> rows{row_of({"a", "1"}, 1.0, 9.0), row_of({"b", "1"}, 2.0, 5.0),
                        row_of({"a", "2"}, 2.0, 3.0), row_of({"b", "2"}, 2.0, 4.0),
                        row_of({"a", "3"}, 2.0, 8.0), row_of({"b", "3"}, 3.0, 2.0)};
  rows.push_back(row_of({"a", "4"}, 0.1, 0.1));
  rows.push_back(row_of({"b", "4"}, 0.1, 0.1));
  rows.back().result = {"", "unstable"};
  const auto candidates = candidates_of(keys, rows);
  ASSERT_EQ(candidates.size(), 4U);
  EXPECT_DOUBLE_EQ(candidates[1].merit.time, 4.0);
  EXPECT_DOUBLE_EQ(candidates[1].merit.contour_error, 4.0);
  EXPECT_EQ(candidates[3].failure, "unstable");
  EXPECT_THAT(pareto_front(candidates), ElementsAre(0U, 1U));
}

TEST(ResultsTable, AFailureHasEmptyFiguresAndIsQuoted) {
  Row row;
  row.point.values = {"a,b"};
  row.result.failure = "unstable, \"x\"";
  const std::string csv = to_csv({"program"}, {row});
  EXPECT_THAT(csv, HasSubstr("program,machining_time_s,planned_time_s,path_length_mm,"
                             "contour_error_max_um"));
  EXPECT_THAT(csv, HasSubstr("\"a,b\",,,,,,,,,,\"unstable, \"\"x\"\"\","));
}

}  // namespace sweep_test
}  // namespace twin::studies::batch
