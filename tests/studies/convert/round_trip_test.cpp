#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "path/smooth_builder.hpp"
#include "programs.hpp"
#include "tests/support/plan.hpp"

namespace twin::studies::convert {
namespace round_trip_test {

using test::blocks_of;
using test::blocks_of_text;

constexpr double kStep = 0.02;  // of the points compared [mm]

class RoundTrip : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(RoundTrip, StaysWithinTheToleranceBothWays) {
  const auto& [name, dialect] = GetParam();
  const Conversion conversion = test::convert_file(name, dialect);
  const auto before =
      test::points_of(blocks_of(*gcode::Reader::open(test::program_path(name))), kStep);
  const auto after = test::points_of(blocks_of_text(conversion.text), kStep);
  EXPECT_LE(test::distance_along(after, before), 0.01);
  EXPECT_LE(test::distance_along(before, after), 0.01);
}

TEST_P(RoundTrip, GroupsCountTheBlocksOfBothPrograms) {
  const auto& [name, dialect] = GetParam();
  const Conversion conversion = test::convert_file(name, dialect);
  std::size_t before = 0;
  std::size_t after = 0;
  for (const Group& group : conversion.groups) {
    before += static_cast<std::size_t>(group.blocks);
    after += static_cast<std::size_t>(group.made);
  }
  EXPECT_EQ(before, blocks_of(*gcode::Reader::open(test::program_path(name))).size());
  EXPECT_EQ(after, blocks_of_text(conversion.text).size());
  EXPECT_GT(conversion.nurbs.blocks, 0);
}

TEST_P(RoundTrip, KeepsFeedratesModesAndRests) {
  const auto& [name, dialect] = GetParam();
  const Conversion conversion = test::convert_file(name, dialect);
  const auto before = blocks_of(*gcode::Reader::open(test::program_path(name)));
  const auto after = blocks_of_text(conversion.text);
  std::size_t i = 0;
  std::size_t j = 0;
  for (const Group& group : conversion.groups) {
    for (std::int64_t k = 0; k < group.made; ++k) {
      const gcode::Block& made = after.at(j++);
      EXPECT_NEAR(made.feedrate, before.at(i).feedrate, 1e-9) << "line " << made.line;
      EXPECT_EQ(made.path_mode, before[i].path_mode) << "line " << made.line;
      EXPECT_EQ(made.tolerance, before[i].tolerance);
      EXPECT_EQ(made.dwell, before[i].dwell);
      if (group.made == 1 && made.motion != gcode::Motion::kNurbs) {
        EXPECT_EQ(made.motion, before[i].motion);
      }
    }
    i += static_cast<std::size_t>(group.blocks);
  }
}

TEST_P(RoundTrip, ComparisonAgreesWithBruteForce) {
  const auto& [name, dialect] = GetParam();
  const Conversion conversion = test::convert_file(name, dialect);
  auto before = gcode::Reader::open(test::program_path(name));
  auto after = gcode::Reader::from_text(conversion.text, "made.nc");
  const auto deviation = compare_programs(*before, after, conversion.groups);
  ASSERT_TRUE(deviation) << to_string(deviation.error());
  const auto old_points =
      test::points_of(blocks_of(*gcode::Reader::open(test::program_path(name))), kStep);
  const auto new_points = test::points_of(blocks_of_text(conversion.text), kStep);
  const double brute = std::max(test::distance_along(new_points, old_points),
                                test::distance_along(old_points, new_points));
  EXPECT_NEAR(deviation->largest, brute, 1e-4);
}

// With rounded corners between NURBS and lines, too: gear's have 54 degrees.
TEST(ConvertedProgram, RunsAsFastAsItsSource) {
  const auto time_of = [](const std::vector<gcode::Block>& blocks) {
    const twin::test::PlanSettings settings;
    std::vector<path::Segment> segments;
    path::SmoothBuilder builder(
        settings.path, settings.model, settings.limits,
        [&](path::Segment&& segment) { segments.push_back(std::move(segment)); });
    for (const gcode::Block& block : blocks) {
      builder.push(block);
    }
    builder.finish();
    return twin::test::plan(segments, settings).time;
  };
  for (const std::string name : {"gear.nc", "dolphin.nc", "butterfly.nc"}) {
    const double source = time_of(blocks_of(*gcode::Reader::open(test::program_path(name))));
    for (const std::string dialect : {"g5.2", "g6.2"}) {
      const double made = time_of(blocks_of_text(test::convert_file(name, dialect).text));
      EXPECT_LE(made, 1.01 * source) << name << " as " << dialect;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Programs, RoundTrip,
                         testing::Combine(testing::Values("dolphin.nc", "oxalis.nc", "mixed.nc"),
                                          testing::Values("g5.2", "g6.2")),
                         [](const auto& param) {
                           const std::string name = std::get<0>(param.param);
                           return name.substr(0, name.find('.')) +
                                  (std::get<1>(param.param) == "g5.2" ? "G52" : "G62");
                         });

TEST(KnotNurbsRoundTrip, IsTheFittedCurve) {
  for (const std::string name : {"dolphin.nc", "oxalis.nc", "mixed.nc"}) {
    std::vector<geometry::Curve> fitted;
    for (const path::Segment& segment : test::segments_of(name)) {
      if (const auto* curve = std::get_if<path::FittedCurve>(&segment.geometry)) {
        fitted.push_back(curve->curve);
      }
    }
    std::size_t k = 0;
    for (const gcode::Block& block : blocks_of_text(test::convert_file(name, "g6.2").text)) {
      if (block.motion != gcode::Motion::kNurbs) {
        continue;
      }
      const geometry::Curve& original = fitted.at(k++);
      for (int i = 0; i <= 200; ++i) {
        const double share = i / 200.0;  // of both domains: the written knots are whole numbers
        const geometry::Curve& written = block.nurbs->curve;
        ASSERT_LT((written.position(share * written.u_max()) -
                   original.position(share * original.u_max()))
                      .norm(),
                  2e-6);
      }
    }
    EXPECT_EQ(k, fitted.size());
  }
}

TEST(KnotNurbsRoundTrip, OfAGivenNurbsIsThatNurbs) {
  for (const std::string dialect : {"g6.2", "g5.2", "fanuc"}) {
    const Conversion conversion = test::convert_file("butterfly_nurbs.nc", dialect);
    auto before = gcode::Reader::open(test::program_path("butterfly_nurbs.nc"));
    auto after = gcode::Reader::from_text(conversion.text, "made.nc");
    const auto deviation = compare_programs(*before, after, conversion.groups);
    ASSERT_TRUE(deviation) << to_string(deviation.error());
    EXPECT_LT(deviation->largest, dialect == "fanuc" ? 1e-4 : 2e-6) << dialect;
    EXPECT_EQ(conversion.curves, 1);
  }
}

TEST(Comparison, FindsABlockThatIsElsewhere) {
  Conversion conversion = test::convert_file("dolphin.nc", "g6.2");
  const auto at = conversion.text.find("X", conversion.text.size() / 2);
  conversion.text.replace(at, 2, "X9");
  auto before = gcode::Reader::open(test::program_path("dolphin.nc"));
  auto after = gcode::Reader::from_text(conversion.text, "made.nc");
  const auto deviation = compare_programs(*before, after, conversion.groups);
  ASSERT_TRUE(deviation) << to_string(deviation.error());
  EXPECT_GT(deviation->largest, 0.1);
}

TEST(Comparison, MissesNoBlock) {
  Conversion conversion = test::convert_file("square.nc", "g6.2");
  const auto end = conversion.text.rfind("M30");
  for (const std::string& text :
       {conversion.text.substr(0, conversion.text.rfind('\n', end - 2) + 1) + "M30\n",
        conversion.text.substr(0, end) + "X1 Y2\nM30\n"}) {
    auto before = gcode::Reader::open(test::program_path("square.nc"));
    auto after = gcode::Reader::from_text(text, "made.nc");
    EXPECT_FALSE(compare_programs(*before, after, conversion.groups));
  }
}

}  // namespace round_trip_test
}  // namespace twin::studies::convert
