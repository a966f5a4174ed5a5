#include <fmt/format.h>

#include <array>
#include <ostream>

#include "core/units.hpp"
#include "tests/support/loop_fixture.hpp"

// The two programs beside what Wang & Yau publish of theirs: Tables 1 and 3, machining times of the
// NURBS rows of Tables 4 and 5.
namespace twin {
namespace published_test {

/// A row of the first table of docs/results.md: a program at one feedrate.
struct Claimed {
  double planned_time;       ///< [s]
  const char* difference;    ///< against the paper's time [%]
  double contour_error_max;  ///< of the encoders [um]
  double contour_error_rms;  ///< [um]
};

struct Published {
  const char* program;
  std::int64_t short_blocks;                // Table 1
  const char *shortest, *mean, *longest;    // [mm], Table 1
  double compression_factor;                // Table 3
  double command_error_max;                 // [um], Table 3
  double command_error_rms;                 // [um], Table 3
  std::array<double, 3> time;               // at 1,000, 2,000 and 3,000 mm/min [s], Tables 4 and 5
  std::array<Claimed, 3> claimed;           // the same
  double table_error_max, table_error_rms;  // at 3,000 mm/min [um]
  double ideal_error_max, ideal_error_rms;  // without friction, with ideal gains [um]
};

const std::array<Published, 2> kPublished{
    {{"oxalis.nc",
      1006,
      "0.091",
      "0.262",
      "0.580",
      18.98,
      3.66,
      0.66,
      {18.715, 9.509, 6.624},
      {{{18.614, "-0.5", 16.9, 4.66}, {9.468, "-0.4", 20.4, 5.00}, {6.585, "-0.6", 20.9, 5.65}}},
      17.1,
      4.95,
      5.87,
      0.33},
     {"dolphin.nc",
      1221,
      "0.106",
      "0.329",
      "0.743",
      18.78,
      6.84,
      0.65,
      {27.416, 13.880, 9.592},
      {{{27.299, "-0.4", 15.1, 4.71}, {13.836, "-0.3", 16.2, 4.86}, {9.565, "-0.3", 17.1, 5.15}}},
      15.4,
      4.32,
      6.40,
      0.28}}};

constexpr double kTimeDoubt = 0.002;  // of a claimed time
constexpr double kErrorDoubt = 0.1;   // of a claimed contour error

double feedrate_of(std::size_t row) {
  return units::mm_per_s_from_mm_per_min(1000.0 * static_cast<double>(row + 1));
}

/// An error is as claimed: neither larger nor smaller, for then the claim is out of date.
void expect_claimed(double error_mm, double claimed_um, const std::string& what) {
  EXPECT_NEAR(units::um_from_mm(error_mm), claimed_um, kErrorDoubt * claimed_um) << what;
}

void PrintTo(const Published& paper, std::ostream* out) { *out << paper.program; }

class PublishedFigures : public test::LoopTest, public ::testing::WithParamInterface<Published> {
 protected:
  const Published& paper = GetParam();
};

TEST_P(PublishedFigures, BlocksAreThoseOfTable1) {
  const results::BlockStats blocks = plan(program(paper.program)).blocks;
  EXPECT_EQ(blocks.short_blocks, paper.short_blocks);
  EXPECT_EQ(fmt::format("{:.3f}", blocks.length_min), paper.shortest);
  EXPECT_EQ(fmt::format("{:.3f}", blocks.length_mean), paper.mean);
  EXPECT_EQ(fmt::format("{:.3f}", blocks.length_max), paper.longest);
}

TEST_P(PublishedFigures, CompressionAndCommandErrorAreNoWorseThanTable3) {
  config::MachineFile file = machine();
  file.path.planner = Planner::kPaper;
  const results::Summary summary = execute(program(paper.program), file, nullptr, std::nullopt);
  EXPECT_GE(summary.compression_factor, paper.compression_factor);
  EXPECT_LE(units::um_from_mm(summary.command_contour_error.max), paper.command_error_max);
  EXPECT_LE(units::um_from_mm(summary.command_contour_error.rms), paper.command_error_rms);
  // The chords differ from any smooth outline by something.
  EXPECT_GT(units::um_from_mm(summary.command_contour_error.rms), 0.1);
}

TEST_P(PublishedFigures, PlannedTimesAreThoseOfTables4And5) {
  for (std::size_t i = 0; i < paper.time.size(); ++i) {
    const Claimed& claimed = paper.claimed[i];
    const double time = plan(program(paper.program), feedrate_of(i)).planned_time;
    EXPECT_NEAR(time, claimed.planned_time, kTimeDoubt * claimed.planned_time)
        << feedrate_of(i) << " mm/s";
    const double difference = 100.0 * (claimed.planned_time / paper.time[i] - 1.0);
    EXPECT_EQ(fmt::format("{:.1f}", difference), claimed.difference) << feedrate_of(i) << " mm/s";
  }
}

TEST_P(PublishedFigures, ContourErrorsAreThoseThatAreClaimed) {
  for (std::size_t i = 0; i < paper.claimed.size(); ++i) {
    const Claimed& claimed = paper.claimed[i];
    const results::Summary summary = run(program(paper.program), "xy_table.toml", feedrate_of(i));
    ASSERT_TRUE(summary.run);
    const std::string where = fmt::format("at {:.2f} mm/s", feedrate_of(i));
    expect_claimed(summary.run->contour_error.max, claimed.contour_error_max, "max " + where);
    expect_claimed(summary.run->contour_error.rms, claimed.contour_error_rms, "RMS " + where);
  }
}

TEST_P(PublishedFigures, TableFollowsAt3000MmPerMin) {
  const results::Summary summary = run(program(paper.program), "xy_table.toml");
  ASSERT_TRUE(summary.run);
  expect_claimed(summary.run->table_contour_error.max, paper.table_error_max, "max");
  expect_claimed(summary.run->table_contour_error.rms, paper.table_error_rms, "RMS");
  // A count is 10 um: no encoder error can be below that of its quantisation, 2.9 um RMS an axis.
  EXPECT_GT(units::um_from_mm(summary.run->contour_error.rms), 2.0);
}

TEST_P(PublishedFigures, TableWithoutFrictionAndWithIdealGainsIsTenTimesBetter) {
  const results::Summary summary = run(program(paper.program), "xy_table_ideal.toml");
  ASSERT_TRUE(summary.run);
  expect_claimed(summary.run->contour_error.max, paper.ideal_error_max, "max");
  expect_claimed(summary.run->contour_error.rms, paper.ideal_error_rms, "RMS");
  EXPECT_LT(units::um_from_mm(summary.run->contour_error.rms), 0.1 * paper.table_error_rms);
  // The maximum is that of the command, at rounded corners.
  EXPECT_LT(units::um_from_mm(summary.run->contour_error.max),
            units::um_from_mm(summary.command_contour_error.max) + 2.0);
}

INSTANTIATE_TEST_SUITE_P(Programs, PublishedFigures, ::testing::ValuesIn(kPublished),
                         [](const auto& tested) {
                           const std::string name = tested.param.program;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace published_test
}  // namespace twin
