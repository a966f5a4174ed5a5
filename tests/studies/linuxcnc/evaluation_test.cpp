#include "studies/linuxcnc/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "studies/linuxcnc/recording.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::linuxcnc {
namespace evaluation_test {

using ::testing::HasSubstr;

constexpr double kRadius = 10.0;  // [mm]

/// A memory in which a set point goes round a circle, its encoder 5 um outside of it.
class EvaluationTest : public ::testing::Test {
 protected:
  void put(double angle) {
    memory.is_recording = 1;
    const double x = kRadius * std::sin(angle);
    const double y = kRadius * (1.0 - std::cos(angle));
    const double out = (kRadius + 0.005) / kRadius;
    const double place[2] = {x, y};
    const double measured[2] = {out * x, kRadius + out * (y - kRadius)};
    for (int i = 0; i < 2; ++i) {
      memory.axis[i].command.is_recorded = 1;
      memory.axis[i].command.position = place[i];
      memory.axis[i].command.offset = 3.0;
      memory.axis[i].mm_per_count = 1e-6;
      memory.axis[i].feedback.counts = std::llround((measured[i] + 3.0) * 1e6);
      memory.axis[i].feedback.table_position = place[i] + 3.0;
    }
    ASSERT_TRUE(recordings.take(memory));
  }
  void draw(double share) {
    for (int i = 0; i < 500; ++i) {
      put(0.0);
    }
    for (int i = 1; i <= 2000; ++i) {
      put(share * 2.0 * M_PI * i / 2000.0);
    }
    for (int i = 0; i < 500; ++i) {
      put(share * 2.0 * M_PI);
    }
    ASSERT_TRUE(recordings.end());
  }
  Expected<results::Summary> evaluate_it(const std::string& program) const {
    return evaluate(
        {folder / "001", gcode::ProgramText::from_text(program, "round.nc"), {}, "test"});
  }

  test::TempFolder folder;
  twin_segment memory{};
  Recordings recordings{folder.path(), 1e-3};
};

TEST_F(EvaluationTest, MeasuresAnEncoderThatIsOutsideOfItsCircle) {
  draw(1.0);
  const auto summary = evaluate_it("G03 X0 Y0 I0 J10 F1885\nM30\n");
  ASSERT_TRUE(summary) << to_string(summary.error());
  EXPECT_NEAR(summary->run->machining_time, 2.0, 1e-9);
  EXPECT_NEAR(summary->run->contour_error.max, 0.005, 2e-6);
  EXPECT_NEAR(summary->run->contour_error.rms, 0.005, 2e-6);
  EXPECT_LT(summary->run->table_contour_error.max, 1e-6);
  EXPECT_LT(summary->command_contour_error.max, 1e-9);
  EXPECT_NEAR(summary->audit.feedrate, 2.0 * M_PI * kRadius / 2.0, 0.01);
  EXPECT_TRUE(std::filesystem::exists(folder / "001/summary.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "001/trace.csv"));
}

TEST_F(EvaluationTest, RefusesARecordingOfAnotherProgram) {
  draw(1.0);
  const auto summary = evaluate_it("G01 X20 Y3 F3000\nM30\n");
  ASSERT_FALSE(summary);
  EXPECT_THAT(summary.error().message, HasSubstr("is not a recording of round.nc"));
}

TEST_F(EvaluationTest, RefusesARecordingThatEndsEarly) {
  draw(0.5);
  const auto summary = evaluate_it("G03 X0 Y0 I0 J10 F1885\nM30\n");
  ASSERT_FALSE(summary);
  EXPECT_THAT(summary.error().message, HasSubstr("LinuxCNC has not come to its end"));
}

TEST_F(EvaluationTest, RefusesARecordingInWhichNothingMoves) {
  put(0.0);
  put(0.0);
  ASSERT_TRUE(recordings.end());
  const auto summary = evaluate_it("G01 X20 Y3 F3000\nM30\n");
  ASSERT_FALSE(summary);
  EXPECT_THAT(summary.error().message, HasSubstr("nothing moves"));
}

TEST_F(EvaluationTest, LeavesOutAMotionThatCameToRestBefore) {
  memory.axis[0].command.is_recorded = 1;
  const auto pass = [&](double position, int recording) {
    memory.axis[0].command.position = position;
    memory.is_recording = recording;
    ASSERT_TRUE(recordings.take(memory));
  };
  for (int i = 0; i < 100; ++i) {
    pass(-1.0 + 0.01 * i, 0);  // homing
  }
  for (int i = 0; i < 50; ++i) {
    pass(0.0, 0);
  }
  for (int i = 1; i <= 100; ++i) {
    pass(0.01 * i, i > 20 ? 1 : 0);
  }
  ASSERT_TRUE(recordings.end());
  const auto summary = evaluate_it("G01 X1 F600\nM30\n");
  ASSERT_TRUE(summary) << to_string(summary.error());
  EXPECT_NEAR(summary->run->machining_time, 0.1, 1e-9);
  EXPECT_LT(summary->command_contour_error.max, 1e-9);
}

TEST_F(EvaluationTest, RecordsWhatWasBeforeTheSignal) {
  memory.axis[0].command.is_recorded = 1;
  for (int i = 0; i < 1000; ++i) {
    memory.axis[0].command.position = 0.001 * i;
    memory.is_recording = i > 900 ? 1 : 0;
    ASSERT_TRUE(recordings.take(memory));
  }
  ASSERT_TRUE(recordings.end());
  memory.is_recording = 1;
  ASSERT_TRUE(recordings.take(memory));
  ASSERT_TRUE(recordings.end());
  ASSERT_EQ(recordings.folders().size(), 2U);
  EXPECT_EQ(recordings.folders()[1].filename(), "002");
}

}  // namespace evaluation_test
}  // namespace twin::studies::linuxcnc
