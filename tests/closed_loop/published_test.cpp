#include <fmt/format.h>

#include <array>
#include <ostream>

#include "core/units.hpp"
#include "tests/closed_loop/loop_fixture.hpp"

// The two programs beside what Wang & Yau publish of theirs: Tables 1 and 3, machining times of the
// NURBS rows of Tables 4 and 5.
namespace twin {
namespace published_test {

struct Published {
  const char* program;
  std::int64_t short_blocks;              // Table 1
  const char *shortest, *mean, *longest;  // [mm], Table 1
  double compression_factor;              // Table 3
  double command_error_max;               // [um], Table 3
  double command_error_rms;               // [um], Table 3
  std::array<double, 3> time;             // at 1,000, 2,000 and 3,000 mm/min [s], Tables 4 and 5
};

const std::array<Published, 2> kPublished{{
    {"oxalis.nc", 1006, "0.091", "0.262", "0.580", 18.98, 3.66, 0.66, {18.715, 9.509, 6.624}},
    {"dolphin.nc", 1221, "0.106", "0.329", "0.743", 18.78, 6.84, 0.65, {27.416, 13.880, 9.592}},
}};

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
    const double feedrate = units::mm_per_s_from_mm_per_min(1000.0 * static_cast<double>(i + 1));
    const double time = plan(program(paper.program), feedrate).planned_time;
    EXPECT_NEAR(time, paper.time[i], 0.05 * paper.time[i]) << feedrate << " mm/s";
  }
}

TEST_P(PublishedFigures, TableFollowsAt3000MmPerMin) {
  const results::Summary summary = run(program(paper.program), "xy_table.toml");
  ASSERT_TRUE(summary.run);
  EXPECT_LT(units::um_from_mm(summary.run->contour_error.rms), 10.0);
  EXPECT_LT(units::um_from_mm(summary.run->contour_error.max), 40.0);
  // A count is 10 um: no encoder error can be below that of its quantisation, 2.9 um RMS an axis.
  EXPECT_GT(units::um_from_mm(summary.run->contour_error.rms), 2.0);
}

TEST_P(PublishedFigures, TableWithoutFrictionAndWithIdealGainsIsTenTimesBetter) {
  const results::Summary summary = run(program(paper.program), "xy_table_ideal.toml");
  ASSERT_TRUE(summary.run);
  EXPECT_LT(units::um_from_mm(summary.run->contour_error.rms), 0.5);
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
