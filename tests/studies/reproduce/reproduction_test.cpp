#include "studies/reproduce/reproduction.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "config/find_file.hpp"
#include "hal/ideal/ideal_machine.hpp"
#include "studies/reproduce/published_columns.hpp"
#include "studies/reproduce/reproduction_files.hpp"
#include "tests/support/temp_folder.hpp"

// Rows run on a machine that is always where it is told to be: what remains is the command's own.
namespace twin::studies::reproduce {
namespace reproduction_test {

using ::testing::HasSubstr;

class ReproductionTest : public ::testing::Test {
 protected:
  ReproductionTest() {
    const auto paper = published();
    request.published.source = paper->source;
    for (const PublishedRow& row : paper->rows) {
      if (row.program == "oxalis" && row.feedrate_mm_per_min == 3000.0 && row.table != 2) {
        request.published.rows.push_back(row);
      }
    }
    request.machine_file = *config::find_machine();
    request.repeats = 2;
    request.folder = folder.path();
    request.running.make_machine = [](const config::MachineFile&) {
      return std::make_unique<hal::ideal::IdealMachine>();
    };
  }

  Request request;
  test::TempFolder folder;
};

TEST_F(ReproductionTest, EachRowIsAnsweredInBothWays) {
  const auto result = reproduce(request);
  ASSERT_TRUE(result) << to_string(result.error());
  for (const Variant& variant : result->variants) {
    ASSERT_EQ(variant.answers.size(), 4U);  // Tables 1, 3 and two rows of Table 4
    EXPECT_NEAR(variant.answers[0].single[0], 1006, 0.0);
    EXPECT_EQ(variant.answers[0].folder, variant.answers[2].folder);  // the same run
    EXPECT_EQ(variant.answers[3].summary.interpolator, "bezier");
    EXPECT_TRUE(std::filesystem::exists(variant.answers[3].folder / "trace.csv"));
    EXPECT_EQ(variant.answers[3].repeats.size(), 7U);
  }
  EXPECT_EQ(result->as_published().answers[3].folder, result->defaults().answers[3].folder);
  EXPECT_NE(result->as_published().answers[2].folder, result->defaults().answers[2].folder);
}

/// A machine that follows exactly: no tracking error, and repeats are all alike.
TEST_F(ReproductionTest, IdealMachineHasNoTrackingErrorAndNoSpread) {
  const auto result = reproduce(request);
  ASSERT_TRUE(result) << to_string(result.error());
  const Answer& row = result->as_published().answers[2];
  for (const std::size_t i : {2U, 3U, 4U, 5U}) {
    EXPECT_LT(row.single[i], 1e-3) << columns_of(4)[i].key;
  }
  for (std::size_t i = 0; i < row.repeats.size(); ++i) {
    EXPECT_NEAR(row.repeats[i].mean, row.single[i], 1e-9);
    EXPECT_NEAR(row.repeats[i].deviation, 0.0, 1e-9);
  }
}

/// Landing on the ends of 51 curves costs a part of a period each.
TEST_F(ReproductionTest, LandingOnCurveEndsTakesLonger) {
  const auto result = reproduce(request);
  ASSERT_TRUE(result) << to_string(result.error());
  const double longer =
      result->as_published().answers[2].single[6] - result->defaults().answers[2].single[6];
  EXPECT_GT(longer, 0.0);
  EXPECT_LT(longer, 0.052);
}

TEST_F(ReproductionTest, TwoTimesGiveTheSameTables) {
  const auto first = reproduce(request);
  ASSERT_TRUE(first);
  const test::TempFolder other;
  request.folder = other.path();
  const auto second = reproduce(request);
  ASSERT_TRUE(second);
  EXPECT_EQ(csv_text(*first), csv_text(*second));
  EXPECT_EQ(json_text(*first), json_text(*second));
  EXPECT_EQ(markdown_text(*first), markdown_text(*second));
}

TEST_F(ReproductionTest, UnknownSettingIsRefused) {
  request.settings = {"limits.jerkk=1"};
  const auto result = reproduce(request);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kUsage);
}

TEST_F(ReproductionTest, FailedRowIsNamed) {
  request.settings = {"limits.travel_max=[10, 10, 10]"};
  const auto result = reproduce(request);
  ASSERT_FALSE(result);
  EXPECT_THAT(to_string(result.error()), HasSubstr("oxalis, NURBS 3,000 mm/min"));
}

TEST_F(ReproductionTest, StopEndsItEarly) {
  const std::atomic<bool> stop{true};
  request.running.stop = &stop;
  const auto result = reproduce(request);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
}

TEST_F(ReproductionTest, ResultsAreWrittenWithoutTracesOfTheWork) {
  const auto out = folder.path() / "out";
  {
    auto workshop = pictures::Workshop::open(out);
    ASSERT_TRUE(workshop);
    request.folder = workshop->folder();
    const auto result = reproduce(request);
    ASSERT_TRUE(result) << to_string(result.error());
    const auto written = write_results(*result, *workshop, pictures::Drawing::kDrawn);
    ASSERT_TRUE(written) << to_string(written.error());
  }
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names, (std::set<std::string>{"figures", "index.html", "reproduce.json", "tables.csv",
                                          "tables.md"}));
  for (const char* const name :
       {"fig12_oxalis.png", "fig14_oxalis.svg", "fig16_oxalis.png", "fig18_oxalis.png"}) {
    EXPECT_GT(std::filesystem::file_size(out / "figures" / name), 10000U) << name;
  }
}

}  // namespace reproduction_test
}  // namespace twin::studies::reproduce
