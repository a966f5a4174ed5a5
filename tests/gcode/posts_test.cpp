#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include "gcode/interpreter/tool_table.hpp"
#include "program.hpp"

namespace twin::gcode {
namespace posts_test {

namespace fs = std::filesystem;

const fs::path kPosts = fs::path(TWIN_SOURCE_DIR) / "tests" / "golden" / "posts";

struct Figures {
  std::size_t rapids = 0;
  std::size_t feeds = 0;  // lines and arcs
  std::size_t rests = 0;
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();
};

Figures figures_of(const std::string& name) {
  ReaderOptions options;
  options.tool_table = (kPosts / "tools.tbl").string();
  auto reader = Reader::open((kPosts / name).string(), options);
  Figures figures;
  const auto blocks = read_rest(*reader);
  EXPECT_TRUE(blocks) << to_string(blocks.error());
  for (const Block& block : blocks ? *blocks : std::vector<Block>{}) {
    figures.rapids += block.motion == Motion::kRapid ? 1U : 0U;
    figures.rests += block.motion == Motion::kDwell ? 1U : 0U;
    figures.feeds += block.feedrate > 0.0 ? 1U : 0U;
    figures.low = figures.low.cwiseMin(block.end);
    figures.high = figures.high.cwiseMax(block.end);
  }
  return figures;
}

TEST(Posts, PocketByFusion) {
  const Figures figures = figures_of("fusion_pocket.nc");
  // A lead in, a helix, four rings of five sides, a lead out; tool 1 is 12.5 mm long.
  EXPECT_EQ(figures.feeds, 25U);
  EXPECT_EQ(figures.low, Vec3(-16.0, -16.0, 0.0));
  EXPECT_EQ(figures.high, Vec3(18.0, 16.0, 27.5));
}

TEST(Posts, HolesByFreeCad) {
  const Figures figures = figures_of("freecad_drilling.ngc");
  // Six holes of one stroke, four of 21 mm in pecks of 5 mm.
  EXPECT_EQ(figures.feeds, 6U + 4U * 5U);
  EXPECT_NEAR(figures.low.z(), 0.0, 1e-12);
}

TEST(Posts, InchContourByMastercamWithG41) {
  const Figures figures = figures_of("mastercam_contour.nc");
  // The cutter of 6.35 mm goes round the outside of a part 3.5 inches wide.
  EXPECT_NEAR(figures.high.x(), 1.75 * 25.4 + 3.175, 1e-9);
  EXPECT_NEAR(figures.high.y(), 1.25 * 25.4 + 3.175, 1e-9);
}

TEST(Posts, EngravingByVectric) {
  const Figures figures = figures_of("vectric_engraving.nc");
  EXPECT_EQ(figures.feeds, 4U * 25U + 2U);
  EXPECT_NEAR(figures.low.z(), 0.0, 1e-12);
}

TEST(Posts, BracketByAFanucPost) {
  const Figures figures = figures_of("fanuc_bracket.nc");
  // A face in four strokes, two slots by a subprogram, four holes in pecks.
  EXPECT_EQ(figures.feeds, 4U + 2U * 5U + 4U * 4U);
  EXPECT_EQ(figures.low.x(), -60.0);
}

}  // namespace posts_test
}  // namespace twin::gcode
