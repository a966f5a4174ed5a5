#include <cmath>
#include <utility>

#include "core/json.hpp"
#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/trace_rows.hpp"

// trace.csv and summary.json are read by other programs: names, order and units are an interface.
namespace twin::cli {
namespace results_test {

using test::content;

class Results : public test::CliTest {
 protected:
  Json run(const std::string& command, const std::string& out,
           const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{command, "ok.nc", "--out", out, "--no-plots", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = twin(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out, "");
    return parse_json(content(folder / (out + "/summary.json")));
  }
};

/// The keys of an object and of the objects in it but the settings, as "a b{c d}".
std::string keys(const Json& json) {
  std::string text;
  for (const auto& [key, value] : json.items()) {
    text += text.empty() ? "" : " ";
    text += key;
    if (value.is_object() && key != "settings") {
      text.append("{").append(keys(value)).append("}");
    }
  }
  return text;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

const std::string kRunHeader =
    "t_s,segment,line,x_cmd_mm,y_cmd_mm,z_cmd_mm,feedrate_mm_per_s,x_enc_mm,y_enc_mm,x_table_mm,"
    "y_table_mm,x_drive_V,y_drive_V,contour_error_um,x_tracking_error_um,y_tracking_error_um";
const std::string kPlanHeader = "t_s,segment,line,x_cmd_mm,y_cmd_mm,z_cmd_mm,feedrate_mm_per_s";

const std::string kPlanKeys1 =
    "program machine hal planner interpolator simulated period_s "
    "blocks{total short length_mm{min mean max}} segments{total curves lines arcs spans} "
    "compression_factor path_length_mm planned_time_s ";
const std::string kOrigin = " version command program_sha256 settings";
const std::string kAxis = "{velocity_mm_per_s acceleration_mm_per_s2 jerk_mm_per_s3}";
const std::string kAudit =
    "audit{feedrate_mm_per_s tangential_acceleration_mm_per_s2 tangential_jerk_mm_per_s3 "
    "normal_acceleration_mm_per_s2 vector_jerk_mm_per_s3 axis{x" +
    kAxis + " y" + kAxis + " z" + kAxis + "}}";
const std::string kCutting =
    "feedrate_fluctuation_percent{max rms} "
    "cutting{time_s command_contour_error_um{max rms}";
const std::string kCuttingRun =
    " contour_error_um{max rms} table_contour_error_um{max rms} "
    "tracking_error_um{x{max rms} y{max rms}}";

/// The names of the maxima that have a place, each of which has the same keys.
std::string take_maxima(Json& summary) {
  std::string names;
  for (const auto& [key, value] : summary["maxima"].items()) {
    names += (names.empty() ? "" : " ") + key;
    EXPECT_EQ(keys(value), "value t_s x_mm y_mm z_mm line segment") << key;
  }
  summary["maxima"] = 0;
  return names;
}

TEST_F(Results, OfARunHaveTheirNamesInOrder) {
  Json summary = run("run", "out");
  EXPECT_THAT(take_maxima(summary),
              ::testing::StartsWith("command_contour_error_max_um contour_error_max_um "
                                    "table_contour_error_max_um x_tracking_error_max_um "
                                    "y_tracking_error_max_um cutting_"));
  EXPECT_EQ(first_line(content(folder / "out/trace.csv")), kRunHeader);
  EXPECT_EQ(keys(summary),
            kPlanKeys1 +
                "machining_time_s certified_deviation_um command_contour_error_um{max rms} "
                "contour_error_um{max rms} "
                "table_contour_error_um{max rms} tracking_error_um{x{max rms} y{max rms}} " +
                kCutting + kCuttingRun + "} " + kAudit +
                " maxima loops{x{bandwidth_Hz phase_margin_deg gain_margin} "
                "y{bandwidth_Hz phase_margin_deg gain_margin}} cycle_time_us{p50 p99 max} "
                "real_time_factor" +
                kOrigin);
  EXPECT_EQ(summary["program"], "ok.nc");
  EXPECT_EQ(summary["machine"], "xy_table");
  EXPECT_EQ(summary["hal"], "mujoco");
  EXPECT_EQ(summary["simulated"], true);
  EXPECT_EQ(summary["period_s"], 0.001);
}

TEST_F(Results, OfAPlanHaveTheSetPointsAlone) {
  Json summary = run("plan", "out");
  take_maxima(summary);
  EXPECT_EQ(first_line(content(folder / "out/trace.csv")), kPlanHeader);
  EXPECT_EQ(keys(summary), kPlanKeys1 +
                               "certified_deviation_um command_contour_error_um{max rms} " +
                               kCutting + "} " + kAudit + " maxima" + kOrigin);
}

TEST_F(Results, OfAPlanHaveItsBoundWhereAskedFor) {
  Json summary = run("plan", "out", {"--bound"});
  take_maxima(summary);
  EXPECT_EQ(keys(summary), kPlanKeys1 + "time_bound_s bound_ratio certified_deviation_um " +
                               "command_contour_error_um{max rms} " + kCutting + "} " + kAudit +
                               " maxima" + kOrigin);
  const double bound = summary["time_bound_s"];
  const double planned = summary["planned_time_s"];
  EXPECT_LT(bound, planned);
  EXPECT_GT(bound, 0.5 * planned);
  EXPECT_NEAR(summary["bound_ratio"].get<double>(), planned / bound, 1e-6);
}

TEST_F(Results, TraceStartsAndEndsAtRestOnThePathsEnds) {
  const Json summary = run("run", "out");
  const test::TraceRows rows(folder / "out/trace.csv");
  const auto t = rows.column("t_s");
  ASSERT_GT(t.size(), 100U);
  for (std::size_t i = 0; i < t.size(); ++i) {
    ASSERT_NEAR(t[i], 0.001 * static_cast<double>(i), 1e-9);
  }
  EXPECT_EQ(rows.column("feedrate_mm_per_s").front(), 0.0);
  EXPECT_EQ(rows.last("feedrate_mm_per_s"), 0.0);
  EXPECT_NEAR(rows.last("x_cmd_mm"), 0.0, 1e-9);
  EXPECT_NEAR(rows.last("y_cmd_mm"), 0.0, 1e-9);
  EXPECT_EQ(rows.column("segment").front(), 0.0);
  EXPECT_EQ(rows.last("segment"), summary["segments"]["total"].get<double>() - 1.0);
  EXPECT_EQ(rows.column("line").front(), 1.0);
  EXPECT_EQ(rows.last("line"), 3.0);
  EXPECT_NEAR(t.back(), summary["machining_time_s"].get<double>(), 1e-9);
}

TEST_F(Results, BeginWhereTheMachineStands) {
  folder.put("ok.nc", "G01 X12 Y5 F600\nX12 Y7\nM2\n");
  for (const std::string hal : {"mujoco", "ideal"}) {
    const Json summary = run("run", hal, {"--set", "program.start_mm=[10, 5, 0]", "--hal", hal});
    const test::TraceRows rows(folder / (hal + "/trace.csv"));
    EXPECT_NEAR(summary["path_length_mm"].get<double>(), 4.0, 0.05);
    EXPECT_NEAR(rows.column("x_cmd_mm").front(), 10.0, 1e-3);
    EXPECT_NEAR(rows.column("x_enc_mm").front(), 10.0, 1e-3);
    EXPECT_NEAR(rows.column("y_enc_mm").front(), 5.0, 1e-3);
    EXPECT_NEAR(rows.column("y_table_mm").front(), 5.0, 0.02);  // the table is off its encoder
    EXPECT_NEAR(rows.last("y_table_mm"), 7.0, 0.02);
    EXPECT_LT(summary["contour_error_um"]["max"].get<double>(), 100.0);
  }
}

TEST_F(Results, NameTheFilesOfSubprograms) {
  folder.put("slot.ngc", "o<slot> sub\nG01 X5 F600\no<slot> endsub\n");
  folder.put("ok.nc", "o<slot> call\nG01 X0\nM2\n");
  const Json summary = run("plan", "out");
  ASSERT_EQ(summary["subprograms"].size(), 1U);
  EXPECT_EQ(summary["subprograms"][0]["file"], "slot.ngc");
  EXPECT_EQ(summary["subprograms"][0]["sha256"], test::text_of(folder / "slot.ngc").sha256());
}

TEST_F(Results, SummaryIsThatOfTheTrace) {
  const Json summary = run("run", "out");
  const test::TraceRows rows(folder / "out/trace.csv");
  const auto figures = [&](const std::string& column) {
    double max = 0.0;
    double squares = 0.0;
    for (const double value : rows.column(column)) {
      max = std::max(max, std::abs(value));
      squares += value * value;
    }
    return std::pair(max, std::sqrt(squares / static_cast<double>(rows.rows())));
  };
  const auto expect_same = [&](const Json& error, const std::string& column) {
    EXPECT_NEAR(error["max"].get<double>(), figures(column).first, 1e-6) << column;
    EXPECT_NEAR(error["rms"].get<double>(), figures(column).second, 1e-6) << column;
  };
  expect_same(summary["contour_error_um"], "contour_error_um");
  expect_same(summary["tracking_error_um"]["x"], "x_tracking_error_um");
  expect_same(summary["tracking_error_um"]["y"], "y_tracking_error_um");
  const auto command = rows.column("x_cmd_mm");
  const auto encoder = rows.column("x_enc_mm");
  const auto error = rows.column("x_tracking_error_um");
  for (std::size_t i = 0; i < error.size(); ++i) {
    ASSERT_NEAR(error[i], 1000.0 * (command[i] - encoder[i]), 1e-9);
  }
}

TEST_F(Results, MaximaAreThoseOfTheTraceAtTheirTimes) {
  folder.put("ok.nc", "G00 X5 Y1 Z1\nG01 Z0 F1200\nX30\nG03 X33 Y4 R3\nG01 X0 Y0\nM30\n");
  const Json summary = run("run", "out", {"--columns", "default,all"});
  const test::TraceRows rows(folder / "out/trace.csv");
  const auto t = rows.column("t_s");
  const auto expect_place = [&](const std::string& key, const std::vector<double>& values) {
    const Json& most = summary["maxima"][key];
    std::size_t largest = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      largest = std::abs(values[i]) > std::abs(values[largest]) ? i : largest;
    }
    EXPECT_NEAR(most["value"].get<double>(), std::abs(values[largest]), 1e-6) << key;
    EXPECT_NEAR(most["t_s"].get<double>(), t[largest], 1e-9) << key;
    EXPECT_EQ(most["line"], rows.column("line")[largest]) << key;
    EXPECT_EQ(most["segment"], rows.column("segment")[largest]) << key;
    EXPECT_NEAR(most["x_mm"].get<double>(), rows.column("x_cmd_mm")[largest], 1e-6) << key;
  };
  expect_place("contour_error_max_um", rows.column("contour_error_um"));
  expect_place("contour_error_max_um", rows.column("contour_error_signed_um"));
  expect_place("table_contour_error_max_um", rows.column("table_contour_error_signed_um"));
  expect_place("command_contour_error_max_um", rows.column("command_contour_error_signed_um"));
  expect_place("x_tracking_error_max_um", rows.column("x_tracking_error_um"));
  // Cutting is what is neither a rapid nor above the plate.
  double largest = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (rows.column("rapid")[i] == 0.0 && rows.column("pen")[i] == 1.0) {
      largest = std::max(largest, rows.column("contour_error_um")[i]);
      ++count;
    }
  }
  EXPECT_NEAR(summary["cutting"]["contour_error_um"]["max"].get<double>(), largest, 1e-6);
  EXPECT_NEAR(summary["cutting"]["time_s"].get<double>(), 0.001 * count, 1e-9);
  EXPECT_LT(summary["cutting"]["time_s"].get<double>(), 0.97 * t.back());
}

/// Peaks of the audit are where differences of the set points are as large.
TEST_F(Results, PlacesOfThePeaksAreWhereTheTraceHasThem) {
  const Json summary = run("run", "out");
  const test::TraceRows rows(folder / "out/trace.csv");
  const auto x = rows.column("x_cmd_mm");
  const auto index = [&](const std::string& key) {
    return static_cast<std::size_t>(
        std::lround(summary["maxima"][key]["t_s"].get<double>() / 0.001));
  };
  const std::size_t v = index("x_velocity_peak_mm_per_s");
  ASSERT_GT(v, 0U);
  EXPECT_NEAR(summary["audit"]["axis"]["x"]["velocity_mm_per_s"].get<double>(),
              std::abs(x[v] - x[v - 1]) / 1e-3, 1e-3);
  const std::size_t a = index("x_acceleration_peak_mm_per_s2");
  ASSERT_GT(a, 0U);
  EXPECT_NEAR(summary["audit"]["axis"]["x"]["acceleration_mm_per_s2"].get<double>(),
              std::abs(x[a + 1] - 2 * x[a] + x[a - 1]) / 1e-6, 1.0);
}

TEST_F(Results, ColumnsAreThoseThatAreChosen) {
  run("run", "out", {"--columns", "t_s,path_mm,x_torque_Nm,x_friction_N"});
  EXPECT_EQ(first_line(content(folder / "out/trace.csv")), "t_s,path_mm,x_torque_Nm,x_friction_N");
  const test::TraceRows rows(folder / "out/trace.csv");
  const Json summary = parse_json(content(folder / "out/summary.json"));
  EXPECT_NEAR(rows.last("path_mm"), summary["path_length_mm"].get<double>(), 0.05);
  double largest = 0.0;
  for (const double friction : rows.column("x_friction_N")) {
    largest = std::max(largest, std::abs(friction));
  }
  EXPECT_GT(largest, 1.0);
  EXPECT_LT(largest, 1000.0);
}

TEST_F(Results, ColumnsThatAreNotThereAreNamed) {
  expect_refusal(twin({"run", "ok.nc", "--out", "out", "--columns", "t_s,x_torq"}), 2,
                 "there is no column 'x_torq'");
  expect_refusal(
      twin({"run", "ok.nc", "--out", "out", "--hal", "ideal", "--columns", "default,x_torque_Nm"}),
      2, "x_torque_Nm is not known of this machine");
  expect_refusal(twin({"plan", "ok.nc", "--out", "out", "--columns", "x_enc_mm"}), 2,
                 "x_enc_mm is not known of a plan");
}

TEST_F(Results, WithoutTraceThereIsTheSummaryAlone) {
  run("run", "out", {"--no-trace"});
  EXPECT_FALSE(exists("out/trace.csv"));
  EXPECT_FALSE(exists("out/report.html"));
  EXPECT_FALSE(exists("out/plots/feedrate_limit.csv"));
}

TEST_F(Results, JsonOnStandardOutputIsTheSummary) {
  const auto result = twin({"run", "ok.nc", "--out", "out", "--no-trace", "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, content(folder / "out/summary.json"));
}

TEST_F(Results, AFailedRunLeavesNothingOfTheRunBefore) {
  ASSERT_EQ(twin({"run", "ok.nc", "--out", "out", "--quiet"}).status, 0);
  EXPECT_TRUE(exists("out/plots"));
  const auto failed = twin({"run", "ok.nc", "--out", "out", "--no-plots", "--hal", "rig", "--rig",
                            "emulated", "--fault", "alarm:x@0.6"});
  expect_refusal(failed, 1, "alarm");
  EXPECT_TRUE(exists("out/trace.partial.csv"));
  const Json partial = parse_json(content(folder / "out/summary.partial.json"));
  EXPECT_TRUE(partial.contains("ended_early"));
  EXPECT_FALSE(partial.contains("planned_time_s"));
  EXPECT_FALSE(partial.contains("blocks"));
  for (const auto& plot : std::filesystem::directory_iterator(folder / "out/plots")) {
    ADD_FAILURE() << plot.path() << " is of the run before";
  }
}

TEST_F(Results, TwoRunsLeaveTheSameBytesButForTheClock) {
  Json first = run("run", "a");
  Json second = run("run", "b");
  EXPECT_EQ(content(folder / "a/trace.csv"), content(folder / "b/trace.csv"));
  for (Json* summary : {&first, &second}) {
    EXPECT_EQ(summary->erase("cycle_time_us"), 1U);
    EXPECT_EQ(summary->erase("real_time_factor"), 1U);
    EXPECT_EQ(summary->erase("command"), 1U);  // it names the folder
  }
  EXPECT_EQ(first.dump(), second.dump());
  run("plan", "out");
  const std::string trace = content(folder / "out/trace.csv");
  const std::string summary = content(folder / "out/summary.json");
  run("plan", "out");
  EXPECT_EQ(content(folder / "out/trace.csv"), trace);
  EXPECT_EQ(content(folder / "out/summary.json"), summary);
}

TEST_F(Results, CommandOfARunIsThatOfThePlan) {
  run("run", "out");
  run("plan", "plan");
  const test::TraceRows moved(folder / "out/trace.csv");
  const test::TraceRows planned(folder / "plan/trace.csv");
  EXPECT_EQ(moved.column("x_cmd_mm"), planned.column("x_cmd_mm"));
  EXPECT_EQ(moved.column("y_cmd_mm"), planned.column("y_cmd_mm"));
}

TEST_F(Results, OptionsAreInForce) {
  const Json slow = run("plan", "a", {"--feedrate-mm-per-min", "600"});
  EXPECT_NEAR(slow["audit"]["feedrate_mm_per_s"].get<double>(), 10.0, 1e-6);
  const Json long_period = run("run", "b", {"--set", "interpolator.period_ms=2", "--hal", "ideal"});
  EXPECT_EQ(long_period["period_s"], 0.002);
  EXPECT_EQ(long_period["hal"], "ideal");
  EXPECT_EQ(long_period["tracking_error_um"]["x"]["max"], 0.0);
}

TEST_F(Results, SummarySaysWhatItWasMadeFrom) {
  const Json plan =
      run("plan", "a", {"--set", "limits.jerk=4e4", "--set", "planning.planner=paper"});
  EXPECT_EQ(plan["planner"], "paper");
  EXPECT_EQ(plan["settings"]["limits"]["jerk_mm_per_s3"], 4e4);
  EXPECT_EQ(plan["settings"]["planning"]["planner"], "paper");
  EXPECT_EQ(plan["program_sha256"], test::text_of(folder / "ok.nc").sha256());
  EXPECT_NE(plan["command"].get<std::string>().find(" plan "), std::string::npos);
  EXPECT_NE(plan["command"].get<std::string>().find(" --set limits.jerk=4e4"), std::string::npos);
  EXPECT_FALSE(plan["version"].get<std::string>().empty());
}

TEST_F(Results, FileThatIsNotWantedAnyMoreGoes) {
  run("run", "out");
  folder.put("out/trace.partial.csv", "left behind\n");
  run("run", "out");
  EXPECT_FALSE(exists("out/trace.partial.csv"));
  EXPECT_TRUE(exists("out/trace.csv"));
}

}  // namespace results_test
}  // namespace twin::cli
