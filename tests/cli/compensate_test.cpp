#include <string>

#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"

namespace twin::cli {
namespace compensate_test {

using ::testing::HasSubstr;

class Compensate : public test::CliTest {
 protected:
  /// Writes c.csv for ok.nc.
  void make() const {
    const auto made = twin({"compensate", "ok.nc", "--out", "c.csv", "--quiet"});
    ASSERT_EQ(made.status, 0) << made.err;
  }
  test::ChildResult run(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"run", "ok.nc", "--no-plots", "--no-report", "--out", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return twin(words);
  }
};

TEST_F(Compensate, ARunFollowsTheFileOnTableAndEmulatedRigAndSaysSo) {
  make();
  for (const std::string hal : {"mujoco", "rig"}) {
    const auto result =
        run(hal == "rig" ? std::vector<std::string>{"--compensate", "c.csv", "--hal", "rig",
                                                    "--rig", "emulated"}
                         : std::vector<std::string>{"--compensate", "c.csv"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("the set points are corrected"));
  }
  const auto both = run({"--compensate"});
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_THAT(both.err, HasSubstr("contour error of the model's table"));
}

TEST_F(Compensate, AHoldFadesTheCorrectionOut) {
  make();
  const auto result = run({"--compensate", "c.csv", "--override", "0.2:0,0.4:100"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("the correction faded out from 0.2"));
}

TEST_F(Compensate, WhatItWasNotMadeForIsRefusedBeforeAnythingMoves) {
  make();
  folder.put("other.nc", "G01 X5 F1200\nX0\n");
  expect_refusal(twin({"run", "other.nc", "--compensate", "c.csv", "--out", "out"}), 1,
                 "was made for another program (ok.nc) than other.nc");
  expect_refusal(run({"--compensate", "c.csv", "--set", "servo.x.kp_per_s=250"}), 1,
                 "was made for other settings of the machine");
  expect_refusal(run({"--compensate", "c.csv", "--set", "interpolator.period_ms=2"}), 1,
                 "was made for a period of 0.001 s");
  expect_refusal(run({"--compensate", "c.csv", "--set", "compensation.limit_mm=1e-5"}), 1,
                 "is beyond compensation.limit_mm");
  expect_refusal(run({"--compensate", "none.csv"}), 1, "none.csv");
  expect_refusal(run({"--compensate", "ok.nc"}), 1, "this is no correction");
  expect_refusal(run({"--compensate", "--set", "table.identified=false"}), 2, "never identified");
}

TEST_F(Compensate, LearnsFromOneRunToTheNext) {
  const auto first = run({"--learn", "learning", "--set-plant", "table.y.coulomb_friction_N=9"});
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.err, HasSubstr("learnt from 1 run in learning"));
  const auto second = run({"--learn", "learning", "--set-plant", "table.y.coulomb_friction_N=9"});
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_THAT(second.err, HasSubstr("learnt from 2 runs"));
  folder.put("learning/learnt.csv", "nonsense\n");
  const auto broken = run({"--learn", "learning"});
  EXPECT_EQ(broken.status, 1);
  EXPECT_THAT(broken.err, HasSubstr("learning/learnt.csv:1: expected"));
}

TEST_F(Compensate, OptionsThatExcludeEachOtherAreBadUsage) {
  expect_refusal(run({"--learn", "d", "--override", "0:50"}), 2, "leave out --override");
  expect_refusal(run({"--learn", "d", "--compensate", "c.csv"}), 2, "leave out the FILE");
  expect_refusal(run({"--tolerance-um", "0"}), 2, "--tolerance-um");
  expect_refusal(run({"--tolerance-um", "15", "--override", "0:50"}), 2, "leave out --override");
}

TEST_F(Compensate, ToleranceAndFastestSayWhatMayBeExpected) {
  const auto result = run({"--tolerance-um", "1000"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("within 1000 um with probability 1.000"));
  EXPECT_THAT(test::content(folder / "out/summary.json"), HasSubstr("predicted: contour error"));
  folder.put("short.nc", "G01 X2 F1200\nY1\n");
  const auto fastest = twin({"fastest", "short.nc", "--tolerance-um", "60", "--out", "f.nc"});
  ASSERT_EQ(fastest.status, 0) << fastest.err;
  EXPECT_THAT(fastest.out, HasSubstr("a feedrate for each stretch"));
  EXPECT_EQ(twin({"plan", "f.nc", "--no-plots", "--out", "plan"}).status, 0);
}

}  // namespace compensate_test
}  // namespace twin::cli
