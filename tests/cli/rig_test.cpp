
#include "core/json.hpp"
#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"
#include "tests/support/sysfs_tree.hpp"
#include "tests/support/trace_rows.hpp"

// The switch --hal rig and the commands of `twin rig`, on emulated boards.
namespace twin::cli {
namespace rig_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Rig : public test::CliTest {
 protected:
  /// No card is here, nor an emulator of this name.
  static std::vector<std::string> nowhere(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--rig-name", "/twin-nobody", "--set", "rig.sysfs=nowhere"});
    return arguments;
  }
};

TEST_F(Rig, SwitchGivesTheSameTraceByteForByte) {
  for (const char* program : {"oxalis.nc", "mixed.nc"}) {
    ASSERT_EQ(twin({"run", program, "--out", "a", "--no-plots", "--quiet"}).status, 0);
    const auto rig = twin({"run", program, "--hal", "rig", "--rig", "emulated", "--out", "b",
                           "--no-plots", "--quiet"});
    ASSERT_EQ(rig.status, 0) << rig.err;
    EXPECT_EQ(test::content(folder / "a/trace.csv"), test::content(folder / "b/trace.csv"));
    const auto summary = parse_json(test::content(folder / "b/summary.json"));
    EXPECT_EQ(summary["hal"], "rig");
    EXPECT_EQ(summary["simulated"], true);
  }
}

TEST_F(Rig, WithoutCardsOneLineNamesWhatWasLookedFor) {
  const auto run = twin(nowhere({"run", "ok.nc", "--hal", "rig", "--out", "out"}));
  expect_refusal(run, 1, "PCI-1716 (13fe:1716) with board ID 0 under nowhere/bus/pci/devices");
  EXPECT_THAT(run.err, HasSubstr("twin rig emulate"));
  EXPECT_FALSE(exists("out/trace.partial.csv"));
  for (const char* command : {"probe", "monitor", "check"}) {
    expect_refusal(twin(nowhere({"rig", command})), 1, "PCI-1716 (13fe:1716)");
  }
}

/// Cards that are plain files: they answer, and all their inputs are low.
class RealCards : public Rig {
 protected:
  RealCards() {
    tree.add("0000:03:00.0", 0x1716, 0);
    tree.add("0000:03:01.0", 0x1784, 0);
  }
  std::vector<std::string> on_cards(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--rig", "cards", "--set", "rig.sysfs=" + tree.root()});
    return arguments;
  }
  /// Both converters have never left 0 V.
  void expect_zero_volts() const {
    const std::string registers = tree.get("0000:03:00.0", "resource2");
    EXPECT_EQ(registers.substr(0x0A, 6), std::string("\x00\x80\x00\x80\x01\x01", 6));
  }

  test::SysfsTree tree;
};

TEST_F(RealCards, NothingIsOpenedBeforeTheUserSaysThatItMayMove) {
  const std::string before = tree.get("0000:03:00.0", "resource2");
  expect_refusal(twin(on_cards({"run", "ok.nc", "--hal", "rig", "--out", "out"})), 2,
                 "--i-know-it-moves");
  expect_refusal(twin(on_cards({"rig", "check"})), 2, "--i-know-it-moves");
  expect_refusal(twin(on_cards({"rig", "home", "--axis", "x"})), 2, "--i-know-it-moves");
  EXPECT_EQ(tree.get("0000:03:00.0", "resource2"), before);
}

TEST_F(RealCards, OpenAlarmLinesAreAlarmsAndNothingMoves) {
  expect_refusal(
      twin(on_cards({"run", "ok.nc", "--hal", "rig", "--out", "out", "--i-know-it-moves"})), 1,
      "axis x");
  expect_zero_volts();
}

TEST_F(RealCards, ProbeNamesThemAndWritesNoOutput) {
  const std::string before = tree.get("0000:03:00.0", "resource2");
  const auto result = twin(on_cards({"rig", "probe"}));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("real cards"), HasSubstr("0000:03:00.0"),
                                HasSubstr("ALM"), ::testing::Not(HasSubstr("simulated"))));
  EXPECT_EQ(tree.get("0000:03:00.0", "resource2"), before);
}

TEST_F(Rig, EmulatorThatIsNotThereIsSaid) {
  expect_refusal(twin({"run", "ok.nc", "--hal", "rig", "--rig", "process", "--rig-name",
                       "/twin-nobody", "--out", "out"}),
                 1, "/twin-nobody");
}

TEST_F(Rig, ProbeShowsCardsAndInputs) {
  const auto result = twin({"rig", "probe", "--rig", "emulated"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("simulated"), HasSubstr("PCI-1716"),
                                HasSubstr("PCI-1784"), HasSubstr("ALM no alarm")));
}

TEST_F(Rig, MonitorShowsCountsAndEnds) {
  const auto result = twin({"rig", "monitor", "--rig", "emulated", "--for", "0.25"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("simulated"), HasSubstr("counts"), HasSubstr("mm")));
}

TEST_F(Rig, CheckFindsASoundTableSound) {
  const auto result = twin({"rig", "check", "--rig", "emulated"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("simulated"), HasSubstr("sound")));
}

TEST_F(Rig, CheckNamesTheAxisWhoseEncoderIsTheWrongWayRound) {
  const auto result = twin({"rig", "check", "--rig", "emulated", "--fault", "encoder_swapped:y@0"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr("rig.y.encoder_reversed"));
  EXPECT_THAT(result.err, HasSubstr("axis y must be put right"));
}

TEST_F(Rig, JogMovesOneAxisAndLeavesItsTrace) {
  const auto result = twin({"rig", "jog", "--rig", "emulated", "--axis", "y", "--distance-mm", "-1",
                            "--feedrate-mm-per-min", "60", "--out", "out"});
  EXPECT_EQ(result.status, 0) << result.err;
  const test::TraceRows rows(folder / "out/trace.csv");
  EXPECT_NEAR(rows.last("y_enc_mm"), -1.0, 0.05);
  EXPECT_NEAR(rows.last("x_enc_mm"), 0.0, 0.05);
}

TEST_F(Rig, JogRefusesWhatIsNoMove) {
  expect_refusal(twin({"rig", "jog", "--rig", "emulated", "--axis", "z", "--distance-mm", "1",
                       "--feedrate-mm-per-min", "60"}),
                 2, "--axis");
  expect_refusal(twin({"rig", "jog", "--rig", "emulated", "--axis", "x"}), 2, "--distance-mm");
  expect_refusal(twin({"rig", "jog", "--rig", "emulated", "--axis", "x", "--distance-mm", "500",
                       "--feedrate-mm-per-min", "60", "--out", "out"}),
                 1, "travel");
}

TEST_F(Rig, OptionsOfTheRigAreRefusedWhereTheyWouldBeIgnored) {
  expect_refusal(twin({"run", "ok.nc", "--fault", "alarm:x@1", "--out", "out"}), 2, "--hal rig");
  expect_refusal(twin({"run", "ok.nc", "--rig", "emulated", "--out", "out"}), 2, "--hal rig");
  expect_refusal(twin({"rig", "monitor", "--rig", "emulated", "--for", "0"}), 2, "--for");
  expect_refusal(twin({"rig", "jog", "--rig", "emulated", "--axis", "x", "--distance-mm", "0",
                       "--feedrate-mm-per-min", "60"}),
                 2, "no move");
}

TEST_F(Rig, HomeEndsAtTheZeroOfTheTable) {
  // Switches at +-6 mm, an index in the middle of each revolution: at -5 and 5 mm.
  for (const bool is_positive : {false, true}) {
    const auto result = twin({"rig", "home", "--rig", "emulated", "--axis", "x", "--out", "out",
                              "--rig-log", "log.txt", "--set", "table.x.travel=6", "--set",
                              is_positive ? "home.x.switch=p-ot" : "home.x.switch=n-ot", "--set",
                              is_positive ? "home.x.zero=-5" : "home.x.zero=5"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out,
                AllOf(HasSubstr(is_positive ? "towards P-OT" : "towards N-OT"),
                      HasSubstr("to the index"), HasSubstr("stands at its zero (simulated)")));
    const std::string log = test::content(folder / "log.txt");
    const std::size_t at = log.rfind("table x ");
    ASSERT_NE(at, std::string::npos) << log;
    EXPECT_NEAR(std::stod(log.substr(at + 8)), 0.0, 0.06) << log;
  }
}

TEST_F(Rig, UnknownCommandIsBadUsage) {
  expect_refusal(twin({"rig", "prob"}), 2, "did you mean probe?");
  expect_refusal(twin({"rig"}), 2, "probe, monitor, check, jog, home, emulate");
  expect_refusal(twin({"rig", "probe", "--moter"}), 2, "unknown option --moter");
}

}  // namespace rig_test
}  // namespace twin::cli
