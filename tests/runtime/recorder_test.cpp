#include "runtime/recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/support/files.hpp"
#include "tests/support/planned.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::runtime {
namespace recorder_test {

using ::testing::StartsWith;

/// Records samples along a line of 10 mm in X.
class RecorderTest : public ::testing::Test {
 protected:
  void create(bool has_machine) {
    std::filesystem::create_directories(folder / "plots");
    Recorder::Options options;
    options.directory = folder.path();
    options.has_machine = has_machine;
    auto created = Recorder::create(options, test::blocks_of("G01 X10 F600\n"));
    ASSERT_TRUE(created) << to_string(created.error());
    recorder.emplace(std::move(*created));
  }

  /// 11 samples, 1 mm apart; the encoder is beside the line by error(i) and behind by 0.25 mm.
  void record(const std::function<double(int)>& error) {
    for (int i = 0; i <= 10; ++i) {
      results::Sample sample;
      sample.t = 0.001 * i;
      sample.line = 1;
      sample.command = {static_cast<double>(i), 0.0, 0.0};
      sample.feedrate_limit = 10.0;
      sample.encoder = {i - 0.25, error(i)};
      sample.table = {i - 0.25, 2.0 * error(i)};
      ASSERT_TRUE(recorder->record(sample));
    }
  }

  bool exists(const char* name) const { return std::filesystem::exists(folder / name); }

  test::TempFolder folder;
  std::optional<Recorder> recorder;
};

TEST_F(RecorderTest, FilesHaveTheirNamesOnlyWhenCommitted) {
  create(true);
  record([](int) { return 0.0; });
  EXPECT_FALSE(exists("trace.csv"));
  EXPECT_TRUE(exists("trace.partial.csv"));
  ASSERT_TRUE(recorder->commit());
  EXPECT_TRUE(exists("trace.csv"));
  EXPECT_FALSE(exists("trace.partial.csv"));
  EXPECT_TRUE(exists("plots/feedrate_limit.csv"));
}

TEST_F(RecorderTest, AbandonedTraceKeepsItsRowsNamedAsPartial) {
  create(true);
  record([](int) { return 0.0; });
  recorder->abandon();
  EXPECT_FALSE(exists("trace.csv"));
  EXPECT_FALSE(exists("plots/feedrate_limit.csv"));
  const std::string text = test::content(folder / "trace.partial.csv");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 12);
}

TEST_F(RecorderTest, PlanHasTheFirstSevenColumns) {
  create(false);
  record([](int) { return 0.0; });
  ASSERT_TRUE(recorder->commit());
  EXPECT_THAT(test::content(folder / "trace.csv"),
              StartsWith("t_s,segment,line,x_cmd_mm,y_cmd_mm,z_cmd_mm,feedrate_mm_per_s\n"
                         "0,0,1,0,0,0,0\n"));
  results::Summary summary;
  recorder->summarise(summary);
  EXPECT_FALSE(summary.run);
}

TEST_F(RecorderTest, FiguresAreThoseOfTheErrorsThatWentIn) {
  create(true);
  const auto error = [](int i) { return i % 2 == 0 ? 0.003 : -0.001; };
  record(error);
  results::Summary summary;
  recorder->summarise(summary);
  ASSERT_TRUE(summary.run);
  // 6 samples of 3 um and 5 of 1 um; the first lies 0.25 mm before the path begins.
  const double first = std::hypot(0.25, 0.003);
  const double squares = first * first + 5.0 * 9e-6 + 5.0 * 1e-6;
  EXPECT_NEAR(summary.run->contour_error.max, first, 1e-12);
  EXPECT_NEAR(summary.run->contour_error.rms, std::sqrt(squares / 11.0), 1e-12);
  EXPECT_NEAR(summary.run->table_contour_error.max, std::hypot(0.25, 0.006), 1e-12);
  EXPECT_NEAR(summary.run->tracking_error[0].rms, 0.25, 1e-12);
  EXPECT_NEAR(summary.run->tracking_error[1].max, 0.003, 1e-12);
  EXPECT_NEAR(summary.command_contour_error.max, 0.0, 1e-12);
  EXPECT_NEAR(summary.run->machining_time, 0.01, 1e-12);
  EXPECT_EQ(recorder->samples(), 11);
  EXPECT_EQ(recorder->last().command.x(), 10.0);
}

TEST_F(RecorderTest, RefusesAFolderThatIsNotThere) {
  Recorder::Options options;
  options.directory = folder / "none";
  const auto created = Recorder::create(options, test::blocks_of("G01 X10 F600\n"));
  ASSERT_FALSE(created);
  EXPECT_EQ(created.error().code, ErrorCode::kFile);
}

}  // namespace recorder_test
}  // namespace twin::runtime
