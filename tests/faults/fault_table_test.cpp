#include "tests/faults/fault_table.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"
#include "tests/support/trace_rows.hpp"

// Every fault behind the wires, through the program as a user runs it. In simulated time, so that
// the figures are the same on every machine.
namespace twin::cli {
namespace fault_table_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;

/// Plant time of the last line of a log that has a text [s]; NaN where none has.
double time_of(const std::string& log, const std::string& text) {
  std::istringstream lines(log);
  double time = std::nan("");
  for (std::string line; std::getline(lines, line);) {
    if (line.find(text) != std::string::npos) {
      time = std::stod(line.substr(std::string("plant ").size()));
    }
  }
  return time;
}

class FaultTable : public test::CliTest, public ::testing::WithParamInterface<test::FaultRow> {
 protected:
  test::ChildResult run(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"run",   "dolphin.nc", "--hal",      "rig",
                                       "--rig", "emulated",   "--rig-log",  "log.txt",
                                       "--out", "out",        "--no-plots", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return twin(arguments);
  }
  void expect_safe_end(const std::string& log) const {
    EXPECT_THAT(log, EndsWith("DAC 0 0x8000, DAC 1 0x8000, digital outputs 0x0000\n"));
  }
};

TEST_P(FaultTable, IsNoticedInTimeAndLeavesTheOutputsSafeAndTheFilesKept) {
  const test::FaultRow& row = GetParam();
  const auto result = run({"--fault", std::string(row.fault)});
  expect_refusal(result, 1, std::string(row.noticed));
  EXPECT_THAT(result.err,
              ::testing::AnyOf(HasSubstr("NC line"), HasSubstr("before the first set point")));
  const std::string log = test::content(folder / "log.txt");
  if (row.fault.starts_with("card_gone_1716")) {
    EXPECT_THAT(log, EndsWith("the PCI-1716 without power\n"));
  } else {
    expect_safe_end(log);
  }
  const double periods = (time_of(log, ": end,") - time_of(log, ": fault ")) / 1e-3;
  EXPECT_LE(periods, row.periods + 1e-6) << log;
  EXPECT_GE(periods, 0.0) << log;
  EXPECT_TRUE(exists("out/trace.partial.csv"));
  EXPECT_TRUE(exists("out/summary.partial.json"));
}

std::string name_of(const ::testing::TestParamInfo<test::FaultRow>& info) {
  std::string name(info.param.fault);
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return name;
}

INSTANTIATE_TEST_SUITE_P(Rows, FaultTable, ::testing::ValuesIn(test::kFaultRows), name_of);

using FaultRun = FaultTable;

TEST_F(FaultRun, WithoutAFaultEndsWellWithTheOutputsSafe) {
  const auto result = run({});
  EXPECT_EQ(result.status, 0) << result.err;
  expect_safe_end(test::content(folder / "log.txt"));
}

TEST_F(FaultRun, SaturatedConverterBrakesOnThePath) {
  // 5 mm/s/V: 10 V are 50 mm/s, and 55 are wanted.
  const auto result =
      run({"--feedrate-mm-per-min", "3300", "--set", "table.x.vref_scale_rpm_per_V=30", "--set",
           "table.y.vref_scale_rpm_per_V=30"});
  expect_refusal(result, 1, "drive command at 10 V for");
  EXPECT_THAT(result.err, HasSubstr("stopped on the path"));
  EXPECT_EQ(test::TraceRows(folder / "out/trace.partial.csv").last("feedrate_mm_per_s"), 0.0);
  expect_safe_end(test::content(folder / "log.txt"));
}

TEST_F(FaultRun, ProgramThatLeavesTheTravelMovesNothing) {
  folder.put("far.nc", "G01 F3000 X10\nX500\nM30\n");
  const auto result = twin({"run", "far.nc", "--hal", "rig", "--rig", "emulated", "--rig-log",
                            "log.txt", "--out", "out", "--no-plots", "--quiet"});
  expect_refusal(result, 1, "far.nc:2:");
  EXPECT_THAT(test::content(folder / "log.txt"), HasSubstr("plant 0.000000 s: end"));
}

TEST_F(FaultRun, FaultThatDoesNotExistIsBadUsage) {
  expect_refusal(run({"--fault", "meltdown:x@1"}), 2, "encoder_frozen");
}

}  // namespace fault_table_test
}  // namespace twin::cli
