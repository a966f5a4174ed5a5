#include <tuple>

#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"

namespace twin::cli {
namespace convert_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class Convert : public test::CliTest {
 protected:
  Convert() {
    std::string text = "G01 X30 F1200\n";
    for (int i = 1; i <= 60; ++i) {
      const double x = 30.0 - 0.25 * i;
      text += "X" + std::to_string(x) + " Y" + std::to_string(0.01 * i * (60 - i)) + " Z" +
              std::to_string(0.01 * i) + "\n";
    }
    folder.put("rising.nc", text + "M30\n");
  }
  std::string content_of(const std::string& name) const { return test::content(folder / name); }
};

TEST_F(Convert, WritesTheFileAndATable) {
  for (const auto& [dialect, extension, word] :
       {std::tuple("g5.2", ".nc", "G05.2 P1 L4"), std::tuple("g6.2", ".nc", "G06.2 P4 Q3 K0"),
        std::tuple("fanuc", ".nc", "G06.2 P4 K0"), std::tuple("bspline", ".mpf", "BSPLINE SD=3")}) {
    const auto result = twin({"convert", "oxalis.nc", "--to", dialect});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("largest deviation from the programmed path"));
    const std::string file = std::string("renders/oxalis/oxalis.") + dialect + extension;
    EXPECT_THAT(result.out, HasSubstr("written to " + file));
    EXPECT_THAT(content_of(file), HasSubstr(word));
    EXPECT_FALSE(exists(file + ".tmp"));
  }
}

TEST_F(Convert, WhatItWritesCanBeRun) {
  ASSERT_EQ(twin({"convert", "ok.nc", "--to", "g6.2", "--out", "made/part.nc", "--quiet"}).status,
            0);
  const auto result = twin({"plan", "made/part.nc", "--out", "out", "--no-plots"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(exists("out/trace.csv"));
}

TEST_F(Convert, UnknownDialectIsBadUsage) {
  expect_refusal(twin({"convert", "ok.nc", "--to", "g5.1"}), 2,
                 "unknown dialect g5.1; did you mean g5.2?");
  expect_refusal(twin({"convert", "ok.nc", "--to", "heidenhain"}), 2,
                 "there are g5.2, g6.2, fanuc, bspline");
  expect_refusal(twin({"convert", "ok.nc"}), 2, "--to");
}

TEST_F(Convert, WhatADialectCannotExpressLeavesNoFile) {
  expect_refusal(twin({"convert", "rising.nc", "--to", "g5.2", "--out", "made.nc"}), 1,
                 "leaves the XY plane");
  EXPECT_FALSE(exists("made.nc"));
}

TEST_F(Convert, ErrorsOfTheProgramNameTheirPlace) {
  folder.put("open.nc", "F600 G0 X1\nG05.2 P1\nX2 Y1 P1\nX3 Y0 P1\nM30\n");
  const auto result = twin({"convert", "open.nc", "--to", "g6.2", "--out", "made.nc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, StartsWith("twin: open.nc:2:1: the G05.2 that begins here has no G05.3"));
  EXPECT_FALSE(exists("made.nc"));
}

TEST_F(Convert, FileThatCannotBeWritten) {
  std::filesystem::create_directory(folder / "taken");
  expect_refusal(twin({"convert", "ok.nc", "--to", "g6.2", "--out", "taken"}), 1, "taken");
  folder.put("file", "");
  expect_refusal(twin({"convert", "ok.nc", "--to", "g6.2", "--out", "file/made.nc"}), 1, "file");
}

TEST_F(Convert, DoesNotWriteOverTheProgramOrADevice) {
  folder.put("own.nc", "G01 X10 F600\nM30\n");
  expect_refusal(twin({"convert", "own.nc", "--to", "g5.2", "--out", "own.nc"}), 2,
                 "is the program itself");
  EXPECT_EQ(std::filesystem::file_size(folder / "own.nc"), 17U);
  expect_refusal(twin({"convert", "ok.nc", "--to", "g5.2", "--out", "/dev/null"}), 1, "/dev/null");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(Convert, ToleranceOfTheMachineFileCounts) {
  const auto narrow =
      twin({"convert", "oxalis.nc", "--to", "g6.2", "--set", "planning.chord_error=0.0005"});
  EXPECT_EQ(narrow.status, 0) << narrow.err;
  EXPECT_THAT(narrow.out, HasSubstr("um of 0.5 um"));
}

}  // namespace convert_test
}  // namespace twin::cli
