
#include "core/json.hpp"
#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"

// The page of a run: made by the run, made again from its folder, and refused for what is no run.
namespace twin::cli {
namespace report_test {

using test::content;
using ::testing::HasSubstr;
using ::testing::Not;

class Report : public test::CliTest {
 protected:
  void run(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"run", "ok.nc", "--out", out, "--no-plots", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = twin(arguments);
    ASSERT_EQ(result.status, 0) << result.err;
  }

  /// What the page knows of its runs.
  Json runs_of(const std::string& page) const {
    const std::string text = content(folder / page);
    const std::string mark = "id=\"runs\">";
    const std::size_t at = text.find(mark) + mark.size();
    return parse_json(text.substr(at, text.find("</script>", at) - at));
  }

  void expect_error(const std::vector<std::string>& arguments, const std::string& text) const {
    const auto result = twin(arguments);
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr(text));
  }
};

TEST_F(Report, OfARunIsTheSameAsThatOfItsFolder) {
  run("out");
  const std::string page = content(folder / "out/report.html");
  EXPECT_THAT(page, Not(HasSubstr("src=\"http")));
  EXPECT_THAT(page, Not(HasSubstr("href=\"http")));
  const auto again = twin({"report", "out", "--out", "again.html"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out, "again.html\n");
  EXPECT_EQ(content(folder / "again.html"), page);
  const auto runs = runs_of("out/report.html");
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0]["summary"], parse_json(content(folder / "out/summary.json")));
  EXPECT_GT(runs[0]["text_bytes"], 0);
}

TEST_F(Report, OfAPlanIsThere) {
  ASSERT_EQ(twin({"plan", "ok.nc", "--out", "out", "--no-plots", "--quiet"}).status, 0);
  EXPECT_EQ(runs_of("out/report.html")[0]["summary"]["hal"], "none");
}

TEST_F(Report, OfSeveralRunsIsOnePage) {
  run("a");
  run("b", {"--set", "servo.x.kp_per_s=200"});
  ASSERT_EQ(twin({"report", "a", "b/", "--out", "both.html"}).status, 0);
  const auto runs = runs_of("both.html");
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0]["name"], "a");
  EXPECT_EQ(runs[1]["name"], "b");
  EXPECT_EQ(runs[1]["summary"]["settings"]["servo.x"]["kp_per_s"], 200.0);
}

TEST_F(Report, OfAnotherProgramThanThatOfTheRunIsWithoutIt) {
  run("out");
  folder.put("ok.nc", "G01 X5 F1200\nM30\n");
  ASSERT_EQ(twin({"report", "out"}).status, 0);
  const auto runs = runs_of("out/report.html");
  EXPECT_FALSE(runs[0].contains("outline"));
  EXPECT_THAT(runs[0]["note"].get<std::string>(), HasSubstr("has changed since the run"));
}

TEST_F(Report, OfARunThatFailedSaysSo) {
  run("out");
  const auto failed = twin({"run", "ok.nc", "--out", "out", "--no-plots", "--quiet", "--hal", "rig",
                            "--rig", "emulated", "--fault", "alarm:x@0.6"});
  EXPECT_EQ(failed.status, 1);
  const auto runs = runs_of("out/report.html");
  EXPECT_EQ(runs[0]["partial"], true);
  EXPECT_THAT(runs[0]["summary"]["ended_early"]["reason"].get<std::string>(), HasSubstr("alarm"));
  ASSERT_EQ(twin({"report", "out"}).status, 0);
  EXPECT_EQ(twin({"render", "out", "--quiet"}).status, 0);
  EXPECT_TRUE(exists("out/plots/contour.png"));
}

TEST_F(Report, OfNoRunIsRefused) {
  std::filesystem::create_directory(folder / "empty");
  expect_error({"report", "empty"},
               "empty/summary.json: cannot be read; is this the folder of a run?");
  expect_error({"report", "missing"}, "missing/summary.json: cannot be read");
  expect_error({"report", "ok.nc"}, "ok.nc/summary.json: cannot be read");
}

TEST_F(Report, WithoutATraceThereIsNone) {
  run("out", {"--no-trace"});
  expect_error({"report", "out"}, "out: holds no trace.csv");
}

TEST_F(Report, OfATraceThatIsNotTheSummarysIsRefused) {
  run("a");
  folder.put("ok.nc", "G01 X9 F1200\nM30\n");
  run("b");
  std::filesystem::copy_file(folder / "b/trace.csv", folder / "a/trace.csv",
                             std::filesystem::copy_options::overwrite_existing);
  expect_error({"report", "a"}, "a/trace.csv: is not the trace of the summary beside it");
}

TEST_F(Report, OfATraceThatIsCutShortNamesTheLine) {
  run("out");
  std::string text = content(folder / "out/trace.csv");
  text.resize(text.size() / 2);
  text.resize(text.rfind(',') - 20);
  folder.put("out/trace.csv", text);
  const auto result = twin({"report", "out"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("out/trace.csv"));
}

}  // namespace report_test
}  // namespace twin::cli
