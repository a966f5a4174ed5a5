#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <string>

#include "tests/support/cli_fixture.hpp"

namespace twin::test {
namespace identify_input_test {

using ::testing::HasSubstr;

/// One row of a recording made up for a test: a mass of 20 kg driven by the force of 10 N/V.
struct Row {
  double t = 0.0;
  double command = 0.0;
  double measured = 0.0;
  double volts = 0.0;
  double force = 0.0;
};

class IdentifyInputTest : public CliTest {
 protected:
  void put_recording(const std::string& name, const std::function<void(Row&, int)>& change,
                     int rows = 3000, double period = 0.001) const {
    std::string text = "t,ref,pos,u,f\n";
    for (int k = 0; k < rows; ++k) {
      const double t = period * k;
      const double w = 6.283;
      Row row{t, 5.0 * std::sin(w * t), 5.0 * std::sin(w * (t - 0.002)), 0.0, 0.0};
      row.force = -20.0 * 5e-3 * w * w * std::sin(w * (t - 0.002)) +
                  (std::cos(w * (t - 0.002)) > 0.0 ? 3.0 : -3.0);
      row.volts = row.force / 10.0;
      row.measured = std::round(row.measured * 1000.0) / 1000.0;
      change(row, k);
      text += std::to_string(row.t) + "," + std::to_string(row.command) + "," +
              std::to_string(row.measured) + "," + std::to_string(row.volts) + "," +
              std::to_string(row.force) + "\n";
    }
    folder.put(name, text);
  }

  ChildResult identify(const std::string& columns, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{
        "identify",
        "r.csv",
        "--out",
        "out/m.toml",
        "--columns",
        "t=t,x_cmd=ref,x_meas=pos" + columns,
        "--evaluations",
        "0",
        "--no-plots",
        "--set",
        "table.physics_step_ms=0.5"};  // what is read is judged, not the fit
    arguments.insert(arguments.end(), more.begin(), more.end());
    return twin(arguments);
  }

  void expect_nothing_written(const ChildResult& result, int status,
                              const std::string& text) const {
    expect_refusal(result, status, text);
    EXPECT_FALSE(exists("out/m.toml"));
    EXPECT_FALSE(exists("out/identify.json"));
  }

  static std::vector<std::string> torque_mode(const std::string& scale = "10") {
    return {"--set", "table.x.drive_mode=torque", "--set", "table.x.force_scale_N_per_V=" + scale};
  }
};

TEST_F(IdentifyInputTest, TorqueModeWantsAScaleAndDriveCommands) {
  put_recording("r.csv", [](Row&, int) {});
  expect_nothing_written(identify(",x_V=u", {"--set", "table.x.drive_mode=torque"}), 2,
                         "needs a scale");
  expect_nothing_written(identify("", torque_mode()), 2, "needs drive commands");
}

TEST_F(IdentifyInputTest, ForceAndVoltsThatContradictEachOtherAreRefused) {
  put_recording("r.csv", [](Row& row, int) { row.force *= 2.0; });
  expect_nothing_written(identify(",x_V=u,x_force=f", torque_mode()), 2, "20 N/V");
}

TEST_F(IdentifyInputTest, AnAxisInTorqueModeIsIdentified) {
  put_recording("r.csv", [](Row&, int) {});
  const ChildResult result = identify(",x_V=u,x_force=f", torque_mode());
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("mass with rotor"));
  EXPECT_TRUE(exists("out/m.toml"));
}

TEST_F(IdentifyInputTest, ACounterOfPeriodsIsATime) {
  put_recording("r.csv", [](Row& row, int k) { row.t = 4711 + k; });
  EXPECT_THAT(identify("").err, HasSubstr("if it counts rows of 2 ms, t=t:2ms"));
  EXPECT_EQ(identify(",t=t:1ms").status, 0);
}

TEST_F(IdentifyInputTest, TimeThatJumpsCutsTheFile) {
  put_recording("r.csv", [](Row& row, int k) { row.t += k >= 1500 ? 3.86 : 0.0; });
  const ChildResult result = identify("");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("from row"));
}

TEST_F(IdentifyInputTest, ACounterAtItsEndIsRefusedWithItsLine) {
  put_recording("r.csv", [](Row& row, int) { row.measured = std::min(row.measured, 4.0); });
  expect_nothing_written(identify(""), 1, "a counter at its end");
}

TEST_F(IdentifyInputTest, AValidationOfAnotherPeriodOrOtherColumnsIsRefused) {
  put_recording("r.csv", [](Row&, int) {});
  put_recording(
      "v.csv", [](Row&, int) {}, 1500, 0.002);
  expect_nothing_written(identify("", {"--validate", "v.csv"}), 1, "rows are 2 ms apart");
  folder.put("w.csv", "time,a,b\n0,1,1\n");
  expect_nothing_written(identify("", {"--validate", "w.csv"}), 1, "no column t");
  EXPECT_EQ(identify("", {"--validate", "r.csv"}).status, 0);
}

TEST_F(IdentifyInputTest, OneDirectionOnlyIsSaid) {
  put_recording("r.csv", [](Row& row, int k) {
    row.command = 0.01 * k + 0.5 * std::sin(0.004 * k);
    row.measured = std::round((row.command - 0.02) * 1000.0) / 1000.0;
  });
  const ChildResult result = identify(",x_V=u,x_force=f", torque_mode());
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("moves in one direction only"));
}

TEST_F(IdentifyInputTest, AForceInAnotherUnitOrTwiceIsBadUsage) {
  put_recording("r.csv", [](Row&, int) {});
  expect_nothing_written(identify(",x_force=f:V"), 2, "x_force cannot be in V");
  expect_nothing_written(identify(",x_force=f,x_torque=u"), 2, "name one");
}

}  // namespace identify_input_test
}  // namespace twin::test
