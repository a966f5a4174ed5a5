#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/cli_fixture.hpp"

// The commands that meet LinuxCNC, as far as they need none.
namespace twin::cli {
namespace linuxcnc_test {

using test::CliTest;
using ::testing::HasSubstr;

class LinuxCncTest : public CliTest {};

TEST_F(LinuxCncTest, ConfigWritesFilesForAxisAndForNoDisplay) {
  const auto result = twin({"linuxcnc", "config", "--out", "config"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* name :
       {"twin.ini", "headless.ini", "stg.ini", "twin.hal", "stg_record.hal", "tool.tbl"}) {
    EXPECT_TRUE(exists(std::string("config/") + name)) << name;
    EXPECT_THAT(result.out, HasSubstr(name));
  }
}

TEST_F(LinuxCncTest, ConfigRefusesAMachineFileThatIsNotThere) {
  expect_refusal(twin({"linuxcnc", "config", "--machine", "none.toml"}), 1, "none.toml");
}

TEST_F(LinuxCncTest, PlantRefusesFaultsThatCannotBe) {
  const auto result = twin({"plant", "--fault", "alarm:x"});
  expect_refusal(result, 2, "it has no time");
  expect_refusal(twin({"plant", "--fault", "card_gone_1784@1"}), 2, "is about a card of the rig");
  expect_refusal(twin({"plant", "--program", "none.nc"}), 1, "none.nc");
}

TEST_F(LinuxCncTest, EvaluateRefusesAFolderWithoutARecording) {
  expect_refusal(twin({"linuxcnc", "evaluate", "nowhere", "ok.nc"}), 1, "trace.csv");
}

TEST_F(LinuxCncTest, ARunNeedsLinuxCncsComponent) {
  expect_refusal(twin({"run", "ok.nc", "--hal", "linuxcnc", "--i-know-it-moves", "--rig-name",
                       "/twin-test-none", "--out", "out"}),
                 1, "loadrt twinctl");
  expect_refusal(twin({"run", "ok.nc", "--hal", "linuxcnc", "--out", "out"}), 2,
                 "machine 'linuxcnc' is real and would move");
  expect_refusal(twin({"run", "ok.nc", "--hal", "linuxcnc", "--i-know-it-moves", "--fault",
                       "alarm:x@1", "--out", "out"}),
                 2, "twin plant takes --fault and --change by itself");
}

TEST_F(LinuxCncTest, CompareKnowsOneOtherController) {
  expect_refusal(twin({"compare", "--with", "fanuc", "ok.nc"}), 2, "fanuc");
  expect_refusal(twin({"compare", "--with", "linuxcnc", "--feedrate-mm-per-min", "600", "ok.nc"}),
                 2, "do not go together");
}

}  // namespace linuxcnc_test
}  // namespace twin::cli
