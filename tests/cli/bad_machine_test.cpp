#include "tests/support/cli_fixture.hpp"

// Machine files and models that cannot be used.
namespace twin::cli {
namespace bad_machine_test {

class BadMachine : public test::CliTest {
 protected:
  test::ChildResult run_on(const std::string& toml) const {
    folder.put("bad.toml", toml);
    return twin({"run", "ok.nc", "--machine", "bad.toml", "--out", "out", "--no-plots"});
  }
};

TEST_F(BadMachine, Missing) {
  expect_refusal(twin({"run", "ok.nc", "--machine", "xy_tabel.toml", "--out", "out"}), 1,
                 "xy_tabel.toml: no such machine file");
}

TEST_F(BadMachine, UnknownKey) {
  expect_refusal(run_on("[limits]\njerk_mm_per_s3 = 50000\njerk_mm_per_s2 = 3\n"), 1,
                 "bad.toml:3:1: unknown key jerk_mm_per_s2 in [limits]");
}

TEST_F(BadMachine, UnknownSection) {
  expect_refusal(run_on("[limit]\njerk = 3\n"), 1, "bad.toml:1");
}

TEST_F(BadMachine, ValueOfAnotherKind) {
  expect_refusal(run_on("[limits]\njerk_mm_per_s3 = \"x\"\n"), 1, "bad.toml:2:18: ");
  expect_refusal(run_on("[planning]\nmin_segments = 2.5\n"), 1, "bad.toml:2:16: ");
  expect_refusal(run_on("[limits]\njerk_mm_per_s3 = nan\n"), 1, "bad.toml:2:18: ");
}

TEST_F(BadMachine, ValueOutOfRangeForItsUnit) {
  const auto result = run_on("[interpolator]\nperiod_ms = 0.0000001\n");
  expect_refusal(result, 1, "bad.toml:2:13: interpolator.period_ms");
  EXPECT_THAT(result.err, ::testing::HasSubstr("0.125 to 4 ms"));
}

TEST_F(BadMachine, NoToml) {
  expect_refusal(run_on("[limits\n"), 1, "bad.toml:1:8: not valid TOML");
  expect_refusal(run_on("<mujoco/>"), 1, "bad.toml:1:1: not valid TOML");
}

TEST_F(BadMachine, ModelIsMissing) {
  expect_refusal(run_on("[table]\nmodel = \"none.xml\"\n"), 1, "none.xml: no such MJCF file");
}

TEST_F(BadMachine, ModelIsBroken) {
  folder.put("broken.xml", "<mujoco><worldbody><body>");
  expect_refusal(run_on("[table]\nmodel = \"broken.xml\"\n"), 1,
                 "broken.xml: MuJoCo cannot load it");
  EXPECT_FALSE(exists("MUJOCO_LOG.TXT"));
}

TEST_F(BadMachine, ModelIsNoTable) {
  folder.put("empty.xml", "<mujoco><worldbody/></mujoco>");
  expect_refusal(run_on("[table]\nmodel = \"empty.xml\"\n"), 1,
                 "empty.xml: the model has no joint named \"x\"");
}

}  // namespace bad_machine_test
}  // namespace twin::cli
