#include <cmath>
#include <functional>

#include "tests/support/cli_fixture.hpp"

namespace twin::test {
namespace identify_test {

/// One row of a recording made up for a test, in mm and s.
struct Row {
  double t = 0.0;
  double command = 0.0;
  double measured = 0.0;
};

class IdentifyTest : public CliTest {
 protected:
  /// Writes a recording of one axis: 3 s of a 5 mm sine of 1 Hz, followed 1 ms late by 1 um counts.
  void put_recording(
      const std::function<void(Row&, int)>& change = [](Row&, int) {},
      const std::string& header = "t_s,x_cmd_mm,x_enc_mm", int rows = 3000) const {
    std::string text = header + "\n";
    for (int k = 0; k < rows; ++k) {
      const double t = 0.001 * k;
      Row row{t, 5.0 * std::sin(6.283 * t), 5.0 * std::sin(6.283 * (t - 0.001))};
      row.measured = std::round(row.measured * 1000.0) / 1000.0;
      change(row, k);
      text += std::to_string(row.t) + "," + std::to_string(row.command) + "," +
              std::to_string(row.measured) + "\n";
    }
    folder.put("r.csv", text);
  }

  ChildResult identify(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"identify",   "r.csv",         "--out",
                                       "out/m.toml", "--evaluations", "0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return twin(arguments);
  }

  void expect_refused(const std::string& text, int status = 1,
                      const std::vector<std::string>& more = {}) const {
    expect_refusal(identify(more), status, text);
    EXPECT_FALSE(exists("out/m.toml"));
    EXPECT_FALSE(exists("out/identify.json"));
  }
};

TEST_F(IdentifyTest, MissingColumnsAreNamedAndThoseThatThereAre) {
  put_recording([](Row&, int) {}, "time,reference,position");
  expect_refused("no column t_s (t)");
  expect_refused("there are: time,reference,position");
  expect_refused("no column ref (x_cmd)", 1, {"--columns", "t=time,x_cmd=ref,x_meas=position"});
}

TEST_F(IdentifyTest, WrongColumnOptionsAreBadUsage) {
  put_recording();
  expect_refused("did you mean x_meas", 2, {"--columns", "x_mes=pos"});
  expect_refused("x_cmd cannot be in ms", 2, {"--columns", "x_cmd=x_cmd_mm:ms"});
  expect_refused("no column is named for x_cmd", 2, {"--columns", "x_cmd="});
  expect_refused("named for two signals", 1, {"--columns", "x_meas=x_cmd_mm"});
}

TEST_F(IdentifyTest, UnevenTimeIsRefusedWithItsLine) {
  put_recording([](Row& row, int k) { row.t += k >= 1500 ? 0.003 : 0.0; });
  expect_refused("r.csv:1502: time is uneven");
}

TEST_F(IdentifyTest, TimeInMillisecondsIsNoticed) {
  put_recording([](Row& row, int) { row.t *= 1000.0; });
  expect_refused("is it in ms? then say --columns t=t_s:ms");
}

TEST_F(IdentifyTest, TimeThatStandsStillIsNoticed) {
  put_recording([](Row& row, int) { row.t = 1.0; });
  expect_refused("time in column t_s does not go on");
}

TEST_F(IdentifyTest, NumbersThatAreNoneAreRefusedWithLineAndColumn) {
  put_recording([](Row& row, int k) { row.measured = k == 10 ? NAN : row.measured; });
  expect_refused("r.csv:12:");
  expect_refused("in column x_enc_mm is not a finite number");
}

TEST_F(IdentifyTest, AFileThatIsTooShortOrEmptyIsRefused) {
  put_recording([](Row&, int) {}, "t_s,x_cmd_mm,x_enc_mm", 50);
  expect_refused("50 rows are too few");
  folder.put("r.csv", "");
  expect_refused("header line");
}

TEST_F(IdentifyTest, MeasuredInMicrometresIsNoticed) {
  put_recording([](Row& row, int) { row.measured *= 1000.0; });
  expect_refused("column x_enc_mm moves 1000 times as far as column x_cmd_mm");
}

TEST_F(IdentifyTest, CommandInMicrometresIsNoticed) {
  put_recording([](Row& row, int) { row.command *= 1000.0; });
  expect_refused("x_cmd_mm moves at up to");
}

TEST_F(IdentifyTest, BothInMetresAreNoticed) {
  put_recording([](Row& row, int) {
    row.command /= 1000.0;
    row.measured /= 1000.0;
  });
  expect_refused("is column x_cmd_mm in m (x_cmd_mm:m)?");
}

TEST_F(IdentifyTest, NoMotionIsNothingToIdentify) {
  put_recording([](Row& row, int) { row.command = row.measured = 1.0; });
  expect_refused("no axis moves");
}

TEST_F(IdentifyTest, AnotherSignalIsNoticed) {
  put_recording([](Row& row, int) { row.measured = 5.0 * std::cos(6.283 * row.t); });
  expect_refused("does not follow column x_cmd_mm");
}

TEST_F(IdentifyTest, ATurnedSignIsNoticed) {
  put_recording([](Row& row, int) { row.measured = -row.measured; });
  expect_refused("its sign is turned round");
}

TEST_F(IdentifyTest, KeysThatAreNotFittedAreBadUsage) {
  put_recording();
  expect_refused("did you mean table.x.coulomb_friction_N", 2,
                 {"--fix", "table.x.coulomb_frction_N"});
  expect_refused("is nothing that a trace is fitted for", 2, {"--free", "limits.jerk"});
}

TEST_F(IdentifyTest, AForeignRecordingOfOneAxisGivesAMachineFileThatPlans) {
  put_recording([](Row& row, int) { row.t *= 1000.0; }, "time,ref,pos", 800);
  const ChildResult result =
      identify({"--columns", "t=time:ms,x_cmd=ref,x_meas=pos", "--fix", "servo.x.kp"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, ::testing::HasSubstr("Y axis: did not move or was not recorded"));
  EXPECT_TRUE(exists("out/identify.json"));
  EXPECT_EQ(twin({"plan", "ok.nc", "--machine", "out/m.toml", "--out", "p", "--no-plots"}).status,
            0);
}

}  // namespace identify_test
}  // namespace twin::test
