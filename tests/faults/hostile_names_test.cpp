#include <algorithm>

#include "core/json.hpp"
#include "tests/faults/whole_files.hpp"
#include "tests/support/cli_fixture.hpp"

// Names of programs that a shell, gnuplot, HTML, JSON or a terminal would take for something else.
namespace twin::faults {
namespace hostile_names_test {

using ::testing::IsEmpty;

struct Name {
  const char* what;
  std::string text;
};

void PrintTo(const Name& name, std::ostream* out) { *out << name.what; }

class HostileName : public test::CliTest, public ::testing::WithParamInterface<Name> {};

/// All of them in a few names, because each run with its pictures takes seconds.
TEST_F(HostileName, IsANameAndNothingElseInEveryOutput) {
  const std::string printable =
      "a'b\"c''d''' $(touch pwned) `touch pwned` <script>&amp; %s%n{}\\n x:y;z|w*? D\u00FCbel";
  for (const std::string& text : {printable, std::string("a\nb\x1b]0;owned\x07 \xFC\x62l")}) {
    const std::string name = text + ".nc";
    folder.put("in/" + name, "G01 X1 F1200\nX0 Y1\nM30\n");
    const auto run = twin({"run", "in/" + name, "--video", "--out", "out/" + name});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(exists("out/" + name + "/plots/contour.png"));
    EXPECT_TRUE(exists("out/" + name + "/video.mp4"));
    const auto summary = parse_json(test::content(folder / ("out/" + name + "/summary.json")));
    if (text == printable) {
      EXPECT_EQ(summary["program"], name);
    }
    EXPECT_EQ(twin({"report", "out/" + name, "--quiet"}).status, 0);
    const Json job{{"program", "in/" + name}, {"hal", "ideal"}};
    folder.put("jobs.jsonl", to_line(job) + "\n");
    const auto batch = twin({"batch", "jobs.jsonl", "--store", "store", "--quiet"});
    EXPECT_EQ(batch.status, text == printable ? 0 : 1) << batch.err;  // bytes that are no UTF-8
    EXPECT_EQ(std::count(batch.err.begin(), batch.err.end(), '\n'), text == printable ? 0 : 1);
    const auto compared = twin({"compare", "in/" + name, "ok.nc", "--out", "compared", "--quiet"});
    EXPECT_EQ(compared.status, 0) << compared.err;
    EXPECT_FALSE(exists("out/" + name + "/plots/pwned"));
  }
  EXPECT_THAT(test::broken_files(folder.path()), IsEmpty());
  EXPECT_FALSE(exists("pwned"));
}

TEST_P(HostileName, IsOneLineInAMessage) {
  const auto missing = twin({"check", "in/" + GetParam().text});
  EXPECT_EQ(missing.status, 1);
  EXPECT_EQ(std::count(missing.err.begin(), missing.err.end(), '\n'), 1) << missing.err;
  EXPECT_EQ(missing.err.find('\x1b'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Names, HostileName,
    ::testing::Values(Name{"quotes", R"(a'b"c''d)"}, Name{"newline", "a\nb"},
                      Name{"command", "$(touch pwned)"}, Name{"backticks", "`touch pwned`"},
                      Name{"dash", "-rf"}, Name{"utf8", "Dübel 軌跡 ✓"},
                      Name{"latin1", "D\xFC\x62\x65l"}, Name{"html", "<script>alert(1)&amp;"},
                      Name{"escape", "a\x1b]0;owned\x07"}, Name{"colon", "http:x;y|z&w*?"},
                      Name{"format", "%s%n{}{0}\\n"}, Name{"blanks", "  a  "}),
    [](const auto& test) { return test.param.what; });

TEST_F(HostileName, ALeadingDashIsAProgramBehindTwoDashes) {
  folder.put("-x.nc", "G01 X5 F1200\nM30\n");
  EXPECT_EQ(twin({"check", "--", "-x.nc"}).status, 0);
}

TEST_F(HostileName, OfDotsAloneIsNoWayOutOfTheFolderOfResults) {
  folder.put("...nc", "G01 X5 F1200\nM30\n");
  ASSERT_EQ(twin({"run", "./...nc", "--no-plots", "--quiet"}).status, 0);
  EXPECT_FALSE(exists("trace.csv"));
}

}  // namespace hostile_names_test
}  // namespace twin::faults
