#include <cmath>
#include <utility>

#include "core/json.hpp"
#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"

namespace twin::cli {
namespace circle_test {

using test::content;
using ::testing::HasSubstr;

class CircleCommand : public test::CliTest {
 protected:
  Json circle(const std::vector<std::string>& more, const std::string& out = "out") const {
    std::vector<std::string> arguments{"circle", "--out", out, "--no-plots", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = twin(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out, "");
    return parse_json(content(folder / (out + "/circle.json")));
  }

  void expect_refused(const std::vector<std::string>& more, int status,
                      const std::string& text) const {
    std::vector<std::string> arguments{"circle", "--out", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refusal(twin(arguments), status, text);
    EXPECT_FALSE(exists("out/circle.json"));
    if (status == 2) {
      EXPECT_FALSE(exists("out")) << "something was written";
    }
  }
};

TEST_F(CircleCommand, OnTheIdealMachineFindsNoDeviation) {
  const Json json = circle({"--hal", "ideal", "--radius-mm", "20"});
  EXPECT_EQ(json["hal"], "ideal");
  EXPECT_EQ(json["radius_mm"], 20.0);
  EXPECT_EQ(json["feedrate_mm_per_s"]["programmed"], 50.0);
  EXPECT_NEAR(json["feedrate_mm_per_s"]["cw"].get<double>(), 50.0, 1e-6);
  for (const char* place : {"table", "encoder"}) {
    const Json& figures = json[place];
    EXPECT_LT(figures["circular_deviation_um"]["ccw"].get<double>(), 1e-3);
    EXPECT_LT(figures["circular_deviation_um"]["cw"].get<double>(), 1e-3);
    EXPECT_LT(figures["bidirectional_circular_deviation_um"].get<double>(), 1e-3);
    EXPECT_LT(figures["circular_hysteresis_um"].get<double>(), 1e-3);
    EXPECT_LT(std::abs(figures["mean_bidirectional_radial_deviation_um"].get<double>()), 1e-3);
  }
  EXPECT_TRUE(json["predicted_radial_deviation_um"].is_null());
}

TEST_F(CircleCommand, LeavesProgramsTracesAndSummariesOfBothSenses) {
  circle({"--radius-mm", "5"});
  for (const std::string sense : {"ccw", "cw"}) {
    EXPECT_TRUE(exists("out/" + sense + "/trace.csv"));
    EXPECT_TRUE(exists("out/" + sense + "/summary.json"));
    EXPECT_EQ(twin({"check", "out/circle_" + sense + ".nc"}).status, 0);
  }
  EXPECT_THAT(content(folder / "out/circle_ccw.nc"), HasSubstr("G03 X4 Y3 I-4 J-3"));
  EXPECT_THAT(content(folder / "out/circle_cw.nc"), HasSubstr("G02 X4 Y3 I-4 J-3"));
}

// Without hum and with fine counts the spikes stand alone.
TEST_F(CircleCommand, SpikesAtTheQuadrantsGrowWithFriction) {
  const auto with_friction = [&](const std::string& x, const std::string& y) {
    return circle({"--set", "table.x.hum_amplitude_mV=0", "--set", "table.y.hum_amplitude_mV=0",
                   "--set", "table.x.encoder_um_per_count=0.1", "--set",
                   "table.y.encoder_um_per_count=0.1", "--set", "table.x.coulomb_friction_N=" + x,
                   "--set", "table.y.coulomb_friction_N=" + y});
  };
  const Json once = with_friction("8", "10")["table"];
  const Json twice = with_friction("16", "20")["table"];
  for (std::size_t q = 0; q < 4; ++q) {
    for (const char* sense : {"ccw", "cw"}) {
      const Json& small = once["reversal_spikes"][q][sense];
      const Json& large = twice["reversal_spikes"][q][sense];
      EXPECT_GT(small["height_um"].get<double>(), once["ripple_um"][sense].get<double>());
      EXPECT_GT(large["height_um"].get<double>(), 1.3 * small["height_um"].get<double>());
      // Behind the reversal, in the direction of motion.
      const double off =
          std::remainder(small["angle_deg"].get<double>() - 90.0 * static_cast<double>(q), 360.0);
      EXPECT_GT(sense == std::string("cw") ? -off : off, 0.0);
      EXPECT_LT(std::abs(off), 15.0);
    }
  }
  EXPECT_GT(twice["circular_hysteresis_um"], once["circular_hysteresis_um"]);
}

// Kp T / (1 - Kf^2) of the radius error is the period's: 2 % at 0.125 ms.
TEST_F(CircleCommand, RadialDeviationIsThatOfEquationThreeOnANearIdealTable) {
  const Json json = circle({"--machine", "xy_table_ideal.toml",
                            "--set",     "servo.x.ka=0",
                            "--set",     "servo.y.ka=0",
                            "--set",     "servo.x.kf=0",
                            "--set",     "servo.y.kf=0",
                            "--set",     "servo.x.kp=60",
                            "--set",     "servo.y.kp=60",
                            "--set",     "interpolator.period_ms=0.125",
                            "--set",     "table.physics_step_ms=0.025",
                            "--set",     "table.x.velocity_gain_Hz=5000",
                            "--set",     "table.y.velocity_gain_Hz=5000",
                            "--set",     "table.x.integral_time_ms=10000",
                            "--set",     "table.y.integral_time_ms=10000"});
  const double predicted = json["predicted_radial_deviation_um"].get<double>();
  EXPECT_LT(predicted, -10.0);
  EXPECT_NEAR(json["table"]["mean_bidirectional_radial_deviation_um"].get<double>() / predicted,
              1.0, 0.02);
}

TEST_F(CircleCommand, DrawsTheCircleAndSaysWhereResultsAre) {
  const auto result = twin({"circle", "--radius-mm", "5", "--feedrate-mm-per-min", "1000"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out,
              HasSubstr("circular test on xy_table (mujoco), radius 5 mm, 1000 mm/min"));
  EXPECT_THAT(result.out, HasSubstr("results in renders/circle"));
  EXPECT_GT(std::filesystem::file_size(folder / "renders/circle/plots/circular_test.png"), 20000U);
  EXPECT_THAT(content(folder / "renders/circle/plots/circular_test.svg"), HasSubstr("</svg>"));
}

TEST_F(CircleCommand, TwoRunsLeaveTheSameBytes) {
  circle({"--radius-mm", "5"}, "a");
  circle({"--radius-mm", "5"}, "b");
  EXPECT_EQ(content(folder / "a/circle.json"), content(folder / "b/circle.json"));
}

TEST_F(CircleCommand, SlowsDownWhereTheLimitsDemandAndSaysSo) {
  const auto result = twin({"circle", "--radius-mm", "1", "--no-plots", "--hal", "ideal", "--set",
                            "limits.acceleration=400"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("the planner's limits let it run at "));
}

TEST_F(CircleCommand, RefusesARadiusThatIsNoneOrLeavesTheTravel) {
  expect_refused({"--radius-mm", "0"}, 2, "--radius-mm 0 is not at least 0.1");
  expect_refused({"--radius-mm", "-5"}, 2, "--radius-mm -5 is not at least 0.1");
  expect_refused({"--radius-mm", "nan"}, 2, "--radius-mm nan is not at least 0.1");
  expect_refused({"--radius-mm", "250"}, 2, "--radius-mm 250 leaves the travel");
  expect_refused({"--radius-mm", "250"}, 2, "room for 200 mm");
  expect_refused({"--radius-mm", "wide"}, 2, "--radius-mm");
}

TEST_F(CircleCommand, RefusesAFeedrateThatTheMachineOrTheTestHasNot) {
  expect_refused({"--feedrate-mm-per-min", "20000"}, 2, "limits.feedrate_mm_per_min = 12000");
  expect_refused({"--feedrate-mm-per-min", "0"}, 2, "--feedrate-mm-per-min");
  expect_refused({"--feedrate-mm-per-min", "5"}, 2, "more than 600 s");
}

TEST_F(CircleCommand, RefusesWhatRunRefuses) {
  expect_refused({"--hal", "rug"}, 2, "--hal");
  expect_refused({"--raduis-mm", "5"}, 2, "did you mean --radius-mm?");
  expect_refused({"--set", "limits.jrk=3"}, 2, "did you mean limits.jerk?");
  expect_refused({"--machine", "none.toml"}, 1, "none.toml");
  folder.put("out", "a file in the way\n");
  const auto blocked = twin({"circle", "--out", "out"});
  EXPECT_EQ(blocked.status, 1);
  EXPECT_THAT(blocked.err, HasSubstr("out: cannot create"));
}

TEST_F(CircleCommand, WithTooFewSetPointsSaysWhatToDo) {
  const auto result = twin({"circle", "--out", "out", "--radius-mm", "0.5", "--no-plots", "--hal",
                            "ideal", "--set", "interpolator.period_ms=4"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("take a larger radius"));
  EXPECT_FALSE(exists("out/circle.json"));
}

}  // namespace circle_test
}  // namespace twin::cli
