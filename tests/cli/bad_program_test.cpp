#include <random>

#include "tests/support/cli_fixture.hpp"

// Programs that cannot be run: one line with file and line, exit status 1, nothing moved.
namespace twin::cli {
namespace bad_program_test {

class BadProgram : public test::CliTest {
 protected:
  /// Runs a program of this text on the simulated table.
  void expect_refused(const std::string& text, const std::string& place,
                      const std::string& reason) const {
    folder.put("bad.nc", text);
    const auto result = twin({"run", "bad.nc", "--out", "out", "--no-plots"});
    expect_refusal(result, 1, place);
    EXPECT_THAT(result.err, ::testing::HasSubstr(reason));
    EXPECT_THAT(result.out, ::testing::IsEmpty());
    EXPECT_FALSE(exists("out")) << "the run was begun";
  }
};

TEST_F(BadProgram, Missing) {
  const auto result = twin({"run", "dolfin.nc", "--out", "out"});
  expect_refusal(result, 1, "dolfin.nc: no such NC program");
  EXPECT_THAT(result.err, ::testing::HasSubstr("dolphin.nc"));
}

TEST_F(BadProgram, Directory) {
  std::filesystem::create_directory(folder / "folder.nc");
  expect_refusal(twin({"run", "folder.nc", "--out", "out"}), 1, "folder.nc: is a directory");
}

TEST_F(BadProgram, BinaryJunk) {
  std::mt19937 random(1);
  for (int i = 0; i < 10; ++i) {
    std::string junk;
    for (int k = 0; k < 5000; ++k) {
      junk.push_back(static_cast<char>(random() & 0xffU));
    }
    expect_refused(junk, "bad.nc", "");
  }
  expect_refused(std::string("\x7f"
                             "ELF\0\0\1",
                             7),
                 "bad.nc:1", "");
  expect_refused(std::string(1000, '\0'), "bad.nc:1", "");
}

TEST_F(BadProgram, Empty) {
  expect_refused("", "bad.nc", "empty");
  expect_refused("(nothing moves)\nG21\nM30\n", "bad.nc", "");
}

TEST_F(BadProgram, UnterminatedComment) {
  // It goes to the end of its line, which is noted.
  folder.put("bad.nc", "G01 X1 F600\n(never ends\nX2\n");
  const auto result = twin({"check", "bad.nc"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out + result.err, ::testing::HasSubstr("line 2"));
}

TEST_F(BadProgram, UnknownCode) {
  expect_refused("G01 X1 F600\nG123 X2\n", "bad.nc:2:1", "G123");
  expect_refused("G01 X1 F600\nM98 P1\n", "bad.nc:2:5", "there is no O1 in the program");
  expect_refused("G01 X1 A90 F600\n", "bad.nc:1:8", "A");
}

TEST_F(BadProgram, NoFeedrate) {
  // The machine file's default holds, which is noted; without one the move is refused.
  folder.put("bad.nc", "G01 X1\n");
  const auto noted = twin({"check", "bad.nc"});
  EXPECT_EQ(noted.status, 0) << noted.err;
  EXPECT_THAT(noted.err, ::testing::HasSubstr("no F yet: 1000 mm/min of program.default_feedrate"));
  const auto refused = twin({"check", "bad.nc", "--set", "program.default_feedrate=0"});
  EXPECT_EQ(refused.status, 1) << refused.err;
  EXPECT_THAT(refused.err, ::testing::HasSubstr("bad.nc:1:5: G01 has no feedrate"));
}

TEST_F(BadProgram, EveryErrorComesBeforeTheNotes) {
  folder.put("bad.nc", "G41 D3 G00 X1 Q2\nG40\nG01 X2 W5 F600\nG02 X4 Y0 I1\nG01 X3 M41\n");
  const auto result = twin({"check", "bad.nc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, ::testing::HasSubstr("bad.nc is refused: 2 errors"));
  EXPECT_LT(result.err.find("bad.nc:3:8"), result.err.find("note: "));
  EXPECT_LT(result.err.find("note: "), result.err.find("is refused"));
}

TEST_F(BadProgram, TheSameErrorIsToldOnceWithItsCount) {
  folder.put("bad.nc", "G0 X1 A1\nA2\nG1 X2 Q1 F60\nX3 A4\n");
  const auto result = twin({"check", "bad.nc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, ::testing::HasSubstr("bad.nc:1:7: there is no axis A"));
  EXPECT_THAT(result.err, ::testing::HasSubstr("(3 times, first here)"));
  EXPECT_THAT(result.err, ::testing::HasSubstr("bad.nc:3:7: Q belongs"));
  EXPECT_THAT(result.err, ::testing::Not(::testing::HasSubstr("bad.nc:2")));
  EXPECT_THAT(result.err, ::testing::HasSubstr("bad.nc is refused: 4 errors"));
}

TEST_F(BadProgram, ParametersOfTheMachineAreGivenBySettings) {
  folder.put("bad.nc", "G00 X#<_hal[a.b-c]> F#<_hal[d]>\n");
  const auto refused = twin({"check", "bad.nc"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.err, ::testing::HasSubstr("bad.nc:1:6: #<_hal[a.b-c]> is known to "));
  const auto given = twin({"check", "bad.nc", "--json", "--set",
                           "program.parameters=_hal[a.b-c]=3.5, #<_hal[d]> = 60"});
  EXPECT_EQ(given.status, 0) << given.err;
  EXPECT_THAT(given.out, ::testing::HasSubstr("3.5"));
  EXPECT_THAT(twin({"check", "bad.nc", "--set", "program.parameters=a5"}).err,
              ::testing::HasSubstr("program.parameters has 'a5': expected #NUMBER=VALUE"));
}

TEST_F(BadProgram, ZeroFeedrate) { expect_refused("G01 X1 F0\n", "bad.nc:1:8", "F0"); }

TEST_F(BadProgram, ImpossibleArc) {
  expect_refused("G01 X10 F600\nG02 X20 Y0 R1\n", "bad.nc:2", "radius 1 mm cannot span 10 mm");
  expect_refused("G01 X10 F600\nG02 X20 Y0 I1\n", "bad.nc:2", "");
}

TEST_F(BadProgram, NumberOverflow) {
  const std::string digits(400, '9');
  expect_refused("G01 F600 X1\nX" + digits + "\n", "bad.nc:2", "X");
  expect_refused("G01 F600 X1e999\n", "bad.nc:1", "exponent");
  expect_refused("G01 F" + digits + " X1\n", "bad.nc:1", "F");
}

TEST_F(BadProgram, NotANumber) {
  expect_refused("G01 F600 Xnan\n", "bad.nc:1", "nan");
  expect_refused("G01 F600 Xinf\n", "bad.nc:1", "inf");
}

TEST_F(BadProgram, TravelExceeded) {
  expect_refused("G01 F600 X10\nX300\n", "bad.nc:2: axis X would go to 300.0000 mm",
                 "travel ends at 200 mm");
  expect_refused("G00 X190 Y-20\nG03 F600 X190 Y20 J20\n", "bad.nc:2: axis X would go to 210",
                 "nothing was moved");
}

TEST_F(BadProgram, ErrorBehindALongSoundPartIsFoundBeforeAnythingMoves) {
  std::string text = "G01 F600\n";
  for (int i = 0; i < 20000; ++i) {
    text += i % 2 == 0 ? "X1\n" : "X2\n";
  }
  expect_refused(text + "X3 Q\n", "bad.nc:20002", "Q");
}

}  // namespace bad_program_test
}  // namespace twin::cli
