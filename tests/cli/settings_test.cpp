#include <sstream>

#include "tests/support/cli_fixture.hpp"

// twin settings, help, and what a copied machine file finds.
namespace twin::cli {
namespace settings_test {

using ::testing::HasSubstr;
using ::testing::Not;

class SettingsCommand : public test::CliTest {
 protected:
  static void expect_narrow(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 80U) << line;
    }
  }
};

TEST_F(SettingsCommand, SaysWhereEachComesFrom) {
  folder.put("my.toml", "[limits]\njerk_mm_per_s3 = 40000\n");
  const auto result =
      twin({"settings", "--machine", "my.toml", "--set", "servo.x.kp=123", "limits"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, ::testing::ContainsRegex("jerk_mm_per_s3 = 40000[.0]* +my.toml"));
  EXPECT_THAT(result.out, ::testing::ContainsRegex("feedrate_mm_per_min = [0-9.]+ +built in"));
  EXPECT_THAT(result.out, Not(HasSubstr("[servo.x]")));
  const auto servo = twin({"settings", "--machine", "my.toml", "--set", "servo.x.kp=123", "servo"});
  EXPECT_THAT(servo.out, ::testing::ContainsRegex("kp_per_s = 123[.0]* +--set"));
  EXPECT_THAT(servo.out, HasSubstr("phase margin"));
}

TEST_F(SettingsCommand, FitsIntoATerminalAndNamesTheNearest) {
  const auto all = twin({"settings"});
  ASSERT_EQ(all.status, 0) << all.err;
  expect_narrow(all.out);
  const auto none = twin({"settings", "limts"});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("did you mean limits?"));
}

TEST_F(SettingsCommand, HelpFitsIntoATerminal) {
  for (const char* const command : {"run", "plan", "report", "settings", "compare", "check"}) {
    const auto help = twin({"help", command});
    EXPECT_EQ(help.status, 0) << help.err;
    EXPECT_EQ(help.out, twin({command, "--help"}).out);
    expect_narrow(help.out);
  }
  EXPECT_EQ(twin({"help"}).out, twin({"--help"}).out);
  EXPECT_EQ(twin({"-V"}).out, twin({"--version"}).out);
  EXPECT_EQ(twin({"version"}).out, twin({"--version"}).out);
}

TEST_F(SettingsCommand, AnOptionThatIsCutShortIsCompleted) {
  const auto result = twin({"run", "ok.nc", "--feedrate", "3"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("did you mean --feedrate-mm-per-min?"));
  EXPECT_THAT(result.err, HasSubstr("twin run --help"));
}

TEST_F(SettingsCommand, ACopiedMachineFileRuns) {
  std::filesystem::copy_file(std::filesystem::path(TWIN_SOURCE_DIR) / "mjcf/xy_table.toml",
                             folder / "copy.toml");
  const auto result =
      twin({"run", "ok.nc", "--machine", "copy.toml", "--out", "out", "--no-trace", "--quiet"});
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(SettingsCommand, TooMuchGainIsCalledUnstable) {
  const auto result = twin(
      {"run", "ok.nc", "--out", "out", "--no-plots", "--quiet", "--set", "servo.x.kp_per_s=900"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("axis x"));
  EXPECT_THAT(result.err, HasSubstr("the position loop is unstable (gain margin 0."));
  EXPECT_THAT(result.err, Not(HasSubstr("check the signs")));
}

TEST_F(SettingsCommand, ASettingGivenTwiceIsCompared) {
  const auto result = twin(
      {"compare", "--set", "servo.x.kp=200", "--set", "servo.x.kp=300", "ok.nc", "--out", "out"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("servo.x.kp=200"));
  EXPECT_TRUE(exists("out/report.html"));
  EXPECT_TRUE(exists("out/servo.x.kp=300/summary.json"));
  const auto folders = twin({"compare", "out/servo.x.kp=200", "out/servo.x.kp=300", "--out", "c"});
  ASSERT_EQ(folders.status, 0) << folders.err;
  EXPECT_TRUE(exists("c/report.html"));
  const auto uneven =
      twin({"compare", "--set", "servo.x.kp=200", "--set", "servo.x.kp=300", "--set",
            "servo.y.kp=1", "--set", "servo.y.kp=2", "--set", "servo.y.kp=3", "ok.nc"});
  EXPECT_EQ(uneven.status, 2);
  EXPECT_THAT(uneven.err, HasSubstr("as many of each"));
}

}  // namespace settings_test
}  // namespace twin::cli
