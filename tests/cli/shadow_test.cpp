#include <string>

#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"

namespace twin::cli {
namespace shadow_test {

using ::testing::HasSubstr;
using ::testing::Not;

class Shadow : public test::CliTest {
 protected:
  test::ChildResult run(const std::string& out, const std::vector<std::string>& more) const {
    std::vector<std::string> words{"run",         "dolphin",    "--feedrate-mm-per-min",
                                   "4000",        "--no-plots", "--quiet",
                                   "--no-report", "--out",      out};
    words.insert(words.end(), more.begin(), more.end());
    return twin(words);
  }
};

TEST_F(Shadow, LearnsWatchesAndEndsARun) {
  ASSERT_EQ(run("healthy", {}).status, 0);
  const auto learnt = twin({"shadow", "--learn", "healthy/trace.csv", "--out", "learnt.json"});
  ASSERT_EQ(learnt.status, 0) << learnt.err;
  EXPECT_THAT(learnt.out, HasSubstr("axis x, position: noise"));

  const auto broken = run("broken", {"--shadow", "learnt.json", "--change", "vref_gain:x=0.95@2"});
  ASSERT_EQ(broken.status, 0) << broken.err;
  EXPECT_THAT(broken.err, HasSubstr("shadow: axis x: gain of V-REF -"));
  EXPECT_THAT(test::content(folder / "broken/shadow.json"), HasSubstr("\"cause\": \"vref_gain\""));
  EXPECT_THAT(test::content(folder / "learnt.history.csv"), HasSubstr("\"dolphin.nc\",x,position"));

  const auto seen = twin({"shadow", "broken/trace.csv", "--learnt", "learnt.json"});
  EXPECT_THAT(seen.out, HasSubstr("axis x: gain of V-REF -"));
  EXPECT_THAT(seen.out, HasSubstr("axis y: nothing has changed"));

  const auto ended = run("ended", {"--shadow", "learnt.json", "--set", "shadow.reaction=stop",
                                   "--change", "vref_gain:x=0.95@2"});
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.err, HasSubstr("the shadow ends the run: axis x: gain of V-REF"));

  expect_refusal(run("other", {"--shadow", "learnt.json", "--set", "table.x.moving_mass_kg=13"}), 1,
                 "of another machine", "other");
}

TEST_F(Shadow, WhatItCannotWatchIsRefused) {
  expect_refusal(run("out", {"--shadow", "--set", "table.identified=false"}), 1,
                 "table.identified is false");
  expect_refusal(run("out", {"--shadow", "--hal", "ideal"}), 2,
                 "this one's position is its set point");
  expect_refusal(run("out", {"--change", "wear:x=2@1"}), 2, "'wear' is no kind of change");
  expect_refusal(run("out", {"--change", "force:x=5@1", "--hal", "ideal"}), 2, "--hal ideal");
}

}  // namespace shadow_test
}  // namespace twin::cli
