#include "studies/compare/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "config/find_file.hpp"
#include "core/json.hpp"
#include "hal/ideal/ideal_machine.hpp"
#include "studies/compare/comparison_files.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::compare {
namespace comparison_test {

using ::testing::HasSubstr;

/// An arc of 60 chords at 3,000 mm/min: one run of short blocks.
std::string arc_program() {
  std::string text = "G01 F3000\n";
  for (int i = 1; i <= 60; ++i) {
    const double angle = 0.02 * i;
    text += "X" + std::to_string(20.0 * std::sin(angle)) + " Y" +
            std::to_string(20.0 - 20.0 * std::cos(angle)) + "\n";
  }
  return text + "M30\n";
}

class ComparisonTest : public ::testing::Test {
 protected:
  ComparisonTest() {
    request.program = test::text_of(folder.put("arc.nc", arc_program()));
    request.machine_file = *config::find_machine();
    request.folder = folder.path();
    request.running.make_machine = [](const config::MachineFile&) {
      return std::make_unique<hal::ideal::IdealMachine>();
    };
  }

  test::TempFolder folder;
  Request request;
};

TEST_F(ComparisonTest, EachInterpolatorRunsTheSameProgram) {
  const auto result = compare(request);
  ASSERT_TRUE(result) << to_string(result.error());
  ASSERT_EQ(result->contestants.size(), 4U);
  EXPECT_EQ(result->contestants[0].name, "nurbs");
  EXPECT_EQ(result->contestants[3].name, "certified");
  EXPECT_EQ(result->contestants[3].planner, "certified");
  EXPECT_GT(result->contestants[0].summary.segments.curves, 0);
  EXPECT_GT(result->contestants[1].summary.segments.curves, 0);
  EXPECT_EQ(result->contestants[2].summary.segments.curves, 0);
  EXPECT_EQ(result->contestants[2].summary.segments.lines, 60);
  // A line leaves the programmed path nowhere; a curve does.
  EXPECT_LT(result->contestants[2].summary.command_contour_error.max, 1e-9);
  EXPECT_GT(result->contestants[0].summary.command_contour_error.max, 1e-5);
  for (const Contestant& contestant : result->contestants) {
    EXPECT_NEAR(contestant.summary.path_length, 24.0, 0.01);
    EXPECT_GE(contestant.summary.planned_time, contestant.plan.time_bound);
    // 24 mm at 50 mm/s, with 2,450 mm/s^2 at both ends
    EXPECT_NEAR(contestant.plan.time_bound, 24.0 / 50.0 + 50.0 / 2450.0, 1e-3);
    EXPECT_GT(contestant.summary.planning_time.value_or(0.0), 0.0);
    EXPECT_TRUE(std::filesystem::exists(contestant.folder / "trace.csv"));
  }
}

/// Each update is a better approximation than the one before it.
TEST_F(ComparisonTest, FluctuationFallsFromUpdateToUpdate) {
  request.program = test::text_of(*config::find_program("butterfly.nc"));
  const auto result = compare(request);
  ASSERT_TRUE(result) << to_string(result.error());
  ASSERT_EQ(result->fluctuations.size(), 8U);
  for (const std::size_t rule : {0U, 4U}) {
    const auto rms = [&](std::size_t update) {
      return result->fluctuations[rule + update].shares.rms;
    };
    EXPECT_EQ(result->fluctuations[rule].parameter_update, "taylor1");
    EXPECT_GT(rms(0), 2.0 * rms(1));
    EXPECT_GT(rms(1), rms(2));
    EXPECT_GE(rms(2) * 1.001, rms(3));
  }
}

TEST_F(ComparisonTest, ProgramWithoutCurvesHasNoFluctuationToCompare) {
  request.program = test::text_of(folder.put("lines.nc", "G01 X20 F3000\nY20\nX0\nM30\n"));
  const auto result = compare(request);
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_TRUE(result->fluctuations.empty());
  EXPECT_THAT(markdown_text(*result), ::testing::Not(HasSubstr("fluctuation under")));
}

TEST_F(ComparisonTest, TextsAgree) {
  const auto result = compare(request);
  ASSERT_TRUE(result) << to_string(result.error());
  std::istringstream csv(interpolators_csv(*result));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "figure,unit,nurbs,bezier,linear,certified");
  const auto json = parse_json(json_text(*result));
  std::size_t figures = 0;
  while (std::getline(csv, line)) {
    ++figures;
    EXPECT_EQ(std::ranges::count(line, ','), 5) << line;
    const std::string key = line.substr(0, line.find(','));
    const double certified = std::stod(line.substr(line.rfind(',') + 1));
    EXPECT_NEAR(json["interpolators"]["certified"][key].get<double>(), certified,
                1e-5 * std::abs(certified) + 1e-12)
        << key;
  }
  EXPECT_EQ(json["interpolators"]["linear"].size(), figures);
  EXPECT_EQ(json["feedrate_fluctuation"].size(), 8U);
  EXPECT_THAT(to_text(grid_of_interpolators(*result)), HasSubstr("machining time"));
}

TEST_F(ComparisonTest, PicturesAndTablesAreWritten) {
  const auto out = folder.path() / "out";
  {
    const auto workshop = pictures::Workshop::open(out);
    ASSERT_TRUE(workshop);
    request.folder = workshop->folder();
    const auto result = compare(request);
    ASSERT_TRUE(result) << to_string(result.error());
    const auto written = write_results(*result, *workshop, pictures::Drawing::kDrawn);
    ASSERT_TRUE(written) << to_string(written.error());
  }
  for (const char* const name :
       {"compare.csv", "compare.md", "compare.json", "fluctuation.csv", "figures/compare.png",
        "figures/compare.svg", "figures/fluctuation.png", "figures/fluctuation.svg",
        "figures/planners.png", "figures/planners.svg"}) {
    EXPECT_GT(std::filesystem::file_size(out / name), 100U) << name;
  }
}

TEST_F(ComparisonTest, ErrorNamesTheInterpolator) {
  request.settings = {"limits.travel_max=[5, 5, 5]"};
  const auto result = compare(request);
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, HasSubstr("nurbs: "));
}

}  // namespace comparison_test
}  // namespace twin::studies::compare
