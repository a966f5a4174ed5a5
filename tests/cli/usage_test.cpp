#include <sstream>

#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"

namespace twin::cli {
namespace usage_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Usage : public test::CliTest {};

TEST_F(Usage, HelpListsTheCommandsOnStdout) {
  const auto result = twin({"--help"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, IsEmpty());
  for (const char* command : {"run", "plan", "circle", "check", "convert", "render", "reproduce"}) {
    EXPECT_THAT(result.out, HasSubstr(std::string("\n  ") + command));
  }
  const auto run = twin({"run", "--help"});
  EXPECT_EQ(run.status, 0);
  for (const char* option : {"--machine", "--hal", "--curves", "--feedrate-mm-per-min", "--set",
                             "--out", "--video", "--no-plots", "--realtime", "--quiet"}) {
    EXPECT_THAT(run.out, HasSubstr(option));
  }
}

TEST_F(Usage, NoLineOfAHelpTextIsLongerThanATerminalIsWide) {
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{},
                                             {"run"},
                                             {"plan"},
                                             {"check"},
                                             {"render"},
                                             {"compare"},
                                             {"reproduce"},
                                             {"circle"},
                                             {"identify"},
                                             {"convert"},
                                             {"rig"},
                                             {"rig", "jog"},
                                             {"rig", "emulate"}}) {
    std::vector<std::string> words = command;
    words.emplace_back("--help");
    std::istringstream lines(twin(words).out);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 80U) << line;
    }
  }
}

TEST_F(Usage, InterpolatorIsTheOldNameOfCurves) {
  const auto plan = [this](const std::string& option, const std::string& out) {
    return twin({"plan", "ok.nc", "--no-plots", "--out", out, option, "linear"});
  };
  const auto present = plan("--curves", "a");
  const auto old = plan("--interpolator", "b");
  EXPECT_EQ(present.status, 0) << present.err;
  EXPECT_EQ(old.status, 0) << old.err;
  EXPECT_THAT(present.err, ::testing::Not(HasSubstr("--interpolator")));
  EXPECT_THAT(old.err, HasSubstr("twin: note: --interpolator is the old name of --curves\n"));
  EXPECT_EQ(test::content(folder / "a/trace.csv"), test::content(folder / "b/trace.csv"));
}

TEST_F(Usage, VersionIsOneLine) {
  const auto result = twin({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, ::testing::MatchesRegex("twin [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST_F(Usage, NoCommandIsBadUsage) { expect_refusal(twin({}), 2, "subcommand is required"); }

TEST_F(Usage, UnknownCommandIsNamedWithTheNearest) {
  expect_refusal(twin({"rn", "ok.nc"}), 2, "unknown command rn; did you mean run?");
}

TEST_F(Usage, UnknownOptionIsNamedWithTheNearest) {
  expect_refusal(twin({"run", "ok.nc", "--out", "out", "--no-plot"}), 2,
                 "unknown option --no-plot; did you mean --no-plots?");
  expect_refusal(twin({"run", "ok.nc", "--sett", "limits.jerk=3"}), 2,
                 "unknown option --sett; did you mean --set?");
  expect_refusal(twin({"--versoin"}), 2, "unknown option --versoin; did you mean --version?");
}

TEST_F(Usage, MissingProgramAndTwoProgramsAreBadUsage) {
  expect_refusal(twin({"run"}), 2, "program");
  expect_refusal(twin({"run", "ok.nc", "ok.nc"}), 2, "program");
}

TEST_F(Usage, ValuesThatAnOptionDoesNotHaveAreBadUsage) {
  expect_refusal(twin({"run", "ok.nc", "--hal", "rug"}), 2, "--hal");
  expect_refusal(twin({"plan", "ok.nc", "--curves", "cubic"}), 2, "--curves");
  expect_refusal(twin({"plan", "ok.nc", "--interpolator", "cubic"}), 2, "--interpolator");
  expect_refusal(twin({"plan", "ok.nc", "--feedrate-mm-per-min", "0"}), 2, "--feedrate-mm-per-min");
  expect_refusal(twin({"plan", "ok.nc", "--feedrate-mm-per-min", "fast"}), 2,
                 "--feedrate-mm-per-min");
}

TEST_F(Usage, SettingThatIsMisspeltIsNamedWithTheNearestKey) {
  const std::vector<std::string> run{"run", "ok.nc", "--out", "out", "--no-plots", "--set"};
  const auto with = [&](const std::string& setting) {
    std::vector<std::string> all = run;
    all.push_back(setting);
    return twin(all);
  };
  expect_refusal(with("limits.jrk=3"), 2, "unknown key limits.jrk; did you mean limits.jerk?");
  expect_refusal(with("limit.jerk=3"), 2, "did you mean limits.jerk?");
  expect_refusal(with("servo.x.kq=3"), 2, "did you mean servo.x.k");
  expect_refusal(with("limits.jerk=-3"), 2, "out of range");
  expect_refusal(with("limits.jerk=abc"), 2, "not a number");
  expect_refusal(with("limits"), 2, "section.key=value");
}

TEST_F(Usage, CheckTellsOfEveryProgramOnItsOwnLine) {
  folder.put("bad.nc", "G77\n");
  folder.put("worse.nc", "G01 X1 F0\n");
  const auto result = twin({"check", "bad.nc", "ok.nc", "worse.nc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr("twin: bad.nc:1:1: "));
  EXPECT_THAT(result.err, HasSubstr("twin: worse.nc:1:"));
  EXPECT_THAT(result.out, HasSubstr("ok.nc: 3 blocks"));
  EXPECT_EQ(twin({"check", "ok.nc"}).status, 0);
}

TEST_F(Usage, RenderNeedsTheFolderOfARun) {
  expect_refusal(twin({"render", "nowhere"}), 1, "nowhere/summary.json");
  std::filesystem::create_directory(folder / "here");
  folder.put("here/summary.json", "[1, 2");
  const auto result = twin({"render", "here"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("is not the summary of a run"));
}

}  // namespace usage_test
}  // namespace twin::cli
