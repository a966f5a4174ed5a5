#include "results/metrics/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "core/json.hpp"

namespace twin::results {
namespace summary_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;

Summary sample_summary() {
  Summary s;
  s.program = "dolphin.nc";
  s.machine = "xy_table";
  s.hal = "mujoco";
  s.interpolator = "nurbs";
  s.blocks = {1286, 1284, 0.1, 0.353, 12.0};
  s.segments = {77, 75, 2, 0};
  s.compression_factor = 16.7;
  s.path_length = 455.123456789;
  s.planned_time = 10.1;
  s.command_contour_error = {0.0031, 0.001};
  s.feedrate_fluctuation = {0.57, 0.01};
  s.audit.feedrate = 50.0;
  s.audit.tangential_jerk = 49999.5;
  s.run = MachineResults{};
  s.run->machining_time = 10.2;
  s.run->contour_error = {0.032, 0.0088};
  s.run->tracking_error[1] = {0.1 + 0.2, 0.05};
  s.run->cycle_time = {4e-7, 1e-6, 5e-5};
  s.run->real_time_factor = 61.5;
  return s;
}

std::vector<std::string> keys(const Json& json) {
  std::vector<std::string> names;
  for (const auto& [key, value] : json.items()) {
    names.push_back(key);
  }
  return names;
}

TEST(SummaryJson, FilesOfSubprogramsHaveTheirChecksums) {
  Summary summary = sample_summary();
  summary.subprograms = {{"slot.ngc", "00ff"}, {"ring.ngc", "1234"}};
  const Json json = parse_json(to_json(summary));
  ASSERT_EQ(json["subprograms"].size(), 2U);
  EXPECT_EQ(json["subprograms"][1]["file"], "ring.ngc");
  EXPECT_EQ(json["subprograms"][1]["sha256"], "1234");
}

TEST(SummaryJson, KeysAreTheInterfaceInItsOrder) {
  const Json json = parse_json(to_json(sample_summary()));
  EXPECT_THAT(
      keys(json),
      testing::ElementsAre("program", "machine", "hal", "planner", "interpolator", "simulated",
                           "period_s", "blocks", "segments", "compression_factor", "path_length_mm",
                           "planned_time_s", "machining_time_s", "command_contour_error_um",
                           "contour_error_um", "table_contour_error_um", "tracking_error_um",
                           "feedrate_fluctuation_percent", "audit", "cycle_time_us",
                           "real_time_factor", "version", "command", "program_sha256", "settings"));
  EXPECT_THAT(keys(json["blocks"]), testing::ElementsAre("total", "short", "length_mm"));
  EXPECT_THAT(keys(json["blocks"]["length_mm"]), testing::ElementsAre("min", "mean", "max"));
  EXPECT_THAT(keys(json["segments"]), testing::ElementsAre("total", "curves", "lines", "arcs"));
  EXPECT_THAT(keys(json["tracking_error_um"]), testing::ElementsAre("x", "y"));
  EXPECT_THAT(keys(json["audit"]),
              testing::ElementsAre("feedrate_mm_per_s", "tangential_acceleration_mm_per_s2",
                                   "tangential_jerk_mm_per_s3", "normal_acceleration_mm_per_s2",
                                   "vector_jerk_mm_per_s3", "axis"));
  EXPECT_THAT(
      keys(json["audit"]["axis"]["z"]),
      testing::ElementsAre("velocity_mm_per_s", "acceleration_mm_per_s2", "jerk_mm_per_s3"));
  EXPECT_THAT(keys(json["cycle_time_us"]), testing::ElementsAre("p50", "p99", "max"));
}

TEST(SummaryJson, SettingsAreAnObjectOfSections) {
  Summary summary = sample_summary();
  summary.settings = {{"limits", "jerk_mm_per_s3", 5e4},
                      {"limits", "travel_max_mm", std::vector<double>{300.0, 300.0, 100.0}},
                      {"planning", "planner", std::string("paper")},
                      {"planning", "look_ahead", std::int64_t{200}},
                      {"safety", "is_on", true}};
  const Json json = parse_json(to_json(summary))["settings"];
  EXPECT_EQ(json.dump(),
            R"({"limits":{"jerk_mm_per_s3":50000.0,"travel_max_mm":[300.0,300.0,100.0]},)"
            R"("planning":{"planner":"paper","look_ahead":200},"safety":{"is_on":true}})");
}

TEST(SummaryJson, SaysWhatTheRunWasMadeFrom) {
  Summary summary = sample_summary();
  summary.planner = "paper";
  summary.version = "1.2.3";
  summary.command = "twin run dolphin.nc";
  EXPECT_FALSE(parse_json(to_json(summary)).contains("notes"));
  summary.notes = {"another planner plans"};
  const Json json = parse_json(to_json(summary));
  EXPECT_EQ(json["planner"], "paper");
  EXPECT_EQ(json["version"], "1.2.3");
  EXPECT_EQ(json["command"], "twin run dolphin.nc");
  EXPECT_EQ(json["notes"], Json({"another planner plans"}));
  const std::string table = to_table(summary, Limits{});
  EXPECT_THAT(table, HasSubstr("paper planner, nurbs"));
  EXPECT_THAT(table, HasSubstr("note                      another planner plans"));
}

TEST(SummaryJson, TheBoundStandsBehindThePlannedTimeWithItsRatio) {
  Summary summary = sample_summary();
  summary.time_bound = 8.08;
  const Json json = parse_json(to_json(summary));
  EXPECT_EQ(json["time_bound_s"], 8.08);
  EXPECT_EQ(json["bound_ratio"], 1.25);
  EXPECT_THAT(to_table(summary, Limits{}), testing::HasSubstr("1.2500 of the bound of 8.080 s"));
}

TEST(SummaryJson, ValuesAreInTheUnitsOfTheirKeys) {
  const Json json = parse_json(to_json(sample_summary()));
  EXPECT_EQ(json["blocks"]["length_mm"]["mean"], 0.353);
  EXPECT_EQ(json["command_contour_error_um"]["max"], 3.1);
  EXPECT_EQ(json["tracking_error_um"]["y"]["max"], 300.0);
  EXPECT_EQ(json["feedrate_fluctuation_percent"]["max"], 57.0);
  EXPECT_EQ(json["cycle_time_us"]["p50"], 0.4);
  EXPECT_EQ(json["path_length_mm"], 455.123457);
  EXPECT_EQ(json["simulated"], true);
}

TEST(SummaryJson, PlanLeavesOutWhatOnlyAMachineHas) {
  Summary plan = sample_summary();
  plan.run.reset();
  const Json json = parse_json(to_json(plan));
  for (const char* key : {"machining_time_s", "contour_error_um", "table_contour_error_um",
                          "tracking_error_um", "cycle_time_us", "real_time_factor"}) {
    EXPECT_FALSE(json.contains(key)) << key;
  }
  EXPECT_TRUE(json.contains("command_contour_error_um"));
}

TEST(SummaryJson, NotANumberIsNullAndTheTextStaysValid) {
  Summary s = sample_summary();
  s.path_length = std::numeric_limits<double>::quiet_NaN();
  s.program = "caf\xe9.nc";
  const Json json = parse_json(to_json(s));
  EXPECT_TRUE(json["path_length_mm"].is_null());
}

TEST(SummaryTable, IsShortAlignedAndHasUnits) {
  const std::string table = to_table(sample_summary(), Limits{});
  std::istringstream stream(table);
  int lines = 0;
  for (std::string line; std::getline(stream, line); ++lines) {
    EXPECT_LE(line.size(), 80U) << line;
    EXPECT_FALSE(line.ends_with(' ')) << line;
  }
  EXPECT_LE(lines, 24);
  EXPECT_THAT(table, HasSubstr("dolphin.nc on xy_table (mujoco, simulated)"));
  EXPECT_THAT(table, HasSubstr("contour error, encoder          32.000       8.800  um"));
  EXPECT_THAT(table, HasSubstr("tangential jerk                49999.5     50000.0  mm/s^3  kept"));
}

TEST(SummaryTable, AVerdictStandsBesideEachLimit) {
  const auto jerk_row = [](double peak) {
    Summary s = sample_summary();
    s.audit.tangential_jerk = peak;
    const std::string table = to_table(s, Limits{});
    const std::size_t row = table.find("tangential jerk");
    return table.substr(row, table.find('\n', row) - row);
  };
  EXPECT_THAT(jerk_row(50020.0), EndsWith("mm/s^3  kept"));
  EXPECT_THAT(jerk_row(50062.0), EndsWith("mm/s^3  kept, doubt 5 %"));
  EXPECT_THAT(jerk_row(53000.0), EndsWith("mm/s^3  exceeded"));
}

TEST(SummaryJson, WallClockIsThereOnTheWallClockOnly) {
  Summary s = sample_summary();
  EXPECT_FALSE(parse_json(to_json(s)).contains("realtime"));
  RealTimeStats figures;
  figures.wake_up = {2e-5, 6e-5, 9e-5, 1e-4};
  figures.late_periods = 3;
  figures.worst_latency = 0.0123;
  figures.notes = {"memory is not locked"};
  s.run->realtime = figures;
  const Json json = parse_json(to_json(s))["realtime"];
  EXPECT_EQ(json["wake_up_us"]["p99.9"], 90.0);
  EXPECT_EQ(json["late_periods"], 3);
  EXPECT_EQ(json["worst_latency_us"], 12300.0);
  EXPECT_EQ(json["notes"][0], "memory is not locked");
  const std::string table = to_table(s, Limits{});
  EXPECT_THAT(table, HasSubstr("3, worst 12300.0 us after its deadline"));
  EXPECT_THAT(table, HasSubstr("note                      memory is not locked"));
}

TEST(Summary, FallbacksOfThePlannerAreSaidWhereThereAreAny) {
  Summary s = sample_summary();
  EXPECT_FALSE(parse_json(to_json(s)).contains("plan_fallbacks"));
  EXPECT_EQ(to_table(s, Limits{}).find("plan fallbacks"), std::string::npos);
  s.plan_fallbacks = 3;
  EXPECT_EQ(parse_json(to_json(s))["plan_fallbacks"], 3);
  EXPECT_NE(to_table(s, Limits{}).find("plan fallbacks"), std::string::npos);
}

TEST(Summary, CertifiedFiguresAreThereWithTheirPlannerOnly) {
  Summary s = sample_summary();
  EXPECT_FALSE(parse_json(to_json(s)).contains("certified_deviation_um"));
  EXPECT_EQ(to_table(s, Limits{}).find("certified"), std::string::npos);
  s.certified = {0.0097, 331};
  const Json json = parse_json(to_json(s));
  EXPECT_DOUBLE_EQ(json["certified_deviation_um"], 9.7);
  EXPECT_EQ(json["segments"]["spans"], 331);
  EXPECT_NE(to_table(s, Limits{}).find("9.700 um"), std::string::npos);
}

TEST(SummaryTable, PlanHasNoMachineRows) {
  Summary plan = sample_summary();
  plan.run.reset();
  const std::string table = to_table(plan, Limits{});
  EXPECT_THAT(table, testing::Not(HasSubstr("encoder")));
  EXPECT_THAT(table, testing::Not(HasSubstr("machining")));
  EXPECT_THAT(table, HasSubstr("plan only"));
}

}  // namespace summary_test
}  // namespace twin::results
