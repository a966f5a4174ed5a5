#include "pictures/video/survey.hpp"

#include <gmock/gmock.h>

#include "tests/support/files.hpp"
#include "tests/support/synthetic_trace.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::pictures::video {
namespace survey_test {

using test::put;
using test::TempFolder;

constexpr const char* kHeader =
    "t_s,line,x_table_mm,y_table_mm,z_cmd_mm,feedrate_mm_per_s,contour_error_um\n";

TEST(SurveyTrace, LooksOnlyAtWhatThePenDraws) {
  const TempFolder directory;
  put(directory.path() / "t.csv", std::string(kHeader) +
                                      "0,1,-90,80,5,0,99\n"
                                      "1,2,10,-20,0,50,3\n"
                                      "2,3,15,20,0,50,7\n"
                                      "3,4,0,0,5,0,50\n");
  const auto survey = survey_trace(directory.path() / "t.csv");
  ASSERT_TRUE(survey);
  EXPECT_EQ(survey->duration, 3.0);
  EXPECT_EQ(survey->largest_error_um, 7.0);
  EXPECT_EQ(survey->largest_rms_um, 7.0);
  EXPECT_EQ(survey->low, Vec2(10, -20));
  EXPECT_EQ(survey->high, Vec2(15, 20));
  EXPECT_EQ(survey->pen_up, 0.1);
}

TEST(SurveyTrace, ThePenDrawsAtTheProgramsZero) {
  const TempFolder directory;
  put(directory.path() / "summary.json", R"({"program_zero_mm": [[1, 12.5]]})");
  put(directory.path() / "trace.csv", std::string(kHeader) +
                                          "0,1,-90,80,12.5,0,99\n"
                                          "1,2,10,-20,12.5,50,3\n"
                                          "2,3,15,20,12.5,50,7\n"
                                          "3,4,0,0,20,0,50\n");
  const auto survey = survey_trace(directory.path() / "trace.csv");
  ASSERT_TRUE(survey);
  EXPECT_EQ(survey->largest_error_um, 7.0);
  EXPECT_EQ(survey->low, Vec2(10, -20));
}

TEST(SurveyTrace, AProgramThatStaysHighIsDrawnAllTheSame) {
  const TempFolder directory;
  put(directory.path() / "t.csv", std::string(kHeader) + "0,1,1,2,5,0,4\n1,1,3,2,5,0,4\n");
  const auto survey = survey_trace(directory.path() / "t.csv");
  ASSERT_TRUE(survey);
  EXPECT_EQ(survey->high, Vec2(3, 2));
  EXPECT_GT(survey->pen_up, 5.0);
}

TEST(SurveyTrace, APlanStandsForATableThatFollowsExactly) {
  const TempFolder directory;
  test::SyntheticRun run;
  run.duration = 0.5;
  ASSERT_TRUE(test::write_synthetic_trace(directory.path(), run, results::Layout::kPlan));
  const auto survey = survey_trace(directory.path() / "trace.csv");
  ASSERT_TRUE(survey);
  EXPECT_FALSE(survey->has_error);
  EXPECT_NEAR(survey->high.x(), 1.35 * run.radius, 0.01);
}

TEST(SurveyTrace, AnEmptyTraceIsAnError) {
  const TempFolder directory;
  put(directory.path() / "t.csv", kHeader);
  const auto survey = survey_trace(directory.path() / "t.csv");
  ASSERT_FALSE(survey);
  EXPECT_EQ(survey.error().message, "the trace has no rows");
}

}  // namespace survey_test
}  // namespace twin::pictures::video
