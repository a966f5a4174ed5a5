#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "tests/support/child.hpp"
#include "tests/support/loop_fixture.hpp"

// What cutting a path into many blocks must not cost: time on the machine, and memory.
namespace twin {
namespace many_blocks_test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kHasSanitizer = true;
#else
constexpr bool kHasSanitizer = false;
#endif

class ManyBlocks : public test::LoopTest {
 protected:
  /// A straight line from the origin in some equal pieces, with the decimals CAM writes.
  std::filesystem::path line(double x, double y, int pieces) const {
    std::string text = "G01 F3000\n";
    for (int i = 1; i <= pieces; ++i) {
      text += fmt::format("X{:.4f} Y{:.4f}\n", x * i / pieces, y * i / pieces);
    }
    return folder.put(fmt::format("line{}.nc", pieces), text);
  }

  /// Round and round a circle of 60 mm, in blocks of 0.1 mm.
  std::filesystem::path circle(int blocks) const {
    const auto file = folder / fmt::format("circle{}.nc", blocks);
    std::ofstream out(file);
    out << "G01 F12000\n";
    for (int i = 1; i <= blocks; ++i) {
      const double angle = 0.1 * i / 60.0;
      out << fmt::format("X{:.4f} Y{:.4f}\n", 60.0 * std::sin(angle),
                         60.0 - 60.0 * std::cos(angle));
    }
    return file;
  }

  double peak_memory(int blocks, const std::string& more = "--no-plots") const {
    const auto result = test::run_twin(
        {"plan", circle(blocks).string(), "--out", "out", "--quiet", "--no-plots", more},
        {folder.path(), {}});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.peak_memory;
  }
};

TEST_F(ManyBlocks, LineIn2000PiecesTakesAsLongAsUncut) {
  config::MachineFile file = machine();
  const double uncut = plan(line(60.0, 80.0, 1)).planned_time;
  EXPECT_NEAR(uncut, 100.0 / 50.0 + 2.0 * std::sqrt(50.0 / file.limits.jerk), 1e-9);
  for (const CurveKind curves : {CurveKind::kNurbs, CurveKind::kBezier, CurveKind::kNone}) {
    file.path.curves = curves;
    file.path.planner = curves == CurveKind::kNurbs ? Planner::kCertified : Planner::kPaper;
    const double cut = execute(line(60.0, 80.0, 2000), file, nullptr, std::nullopt).planned_time;
    EXPECT_NEAR(cut, uncut, file.period) << kCurveNames[static_cast<std::size_t>(curves)];
  }
}

TEST_F(ManyBlocks, LineInPiecesWithRoundedDecimalsTakesAsLongAsUncut) {
  const double uncut = plan(line(37.0, 91.0, 1)).planned_time;
  EXPECT_NEAR(plan(line(37.0, 91.0, 1999)).planned_time, uncut, machine().period);
}

TEST_F(ManyBlocks, MillionShortBlocksNeedLessThan200MB) {
  if (kHasSanitizer) {
    GTEST_SKIP() << "a sanitizer's own memory counts too";
  }
  EXPECT_LT(peak_memory(1000000), 200.0);
}

TEST_F(ManyBlocks, MemoryDoesNotDependOnTheProgramsLength) {
  if (kHasSanitizer) {
    GTEST_SKIP() << "a sanitizer's own memory counts too";
  }
  // By then the segments between planner and motion have all been as large as they get.
  constexpr int kEnough = 800000;
  // A page holds its rows, up to a million of them.
  const double of_one = peak_memory(kEnough, "--no-report");
  double of_two = peak_memory(2 * kEnough, "--no-report");
  if (of_two >= of_one + 5.0) {
    // On a busy machine the recorder falls behind and blocks are kept for it: measured once more.
    of_two = peak_memory(2 * kEnough, "--no-report");
  }
  EXPECT_LT(of_two, of_one + 5.0);
}

}  // namespace many_blocks_test
}  // namespace twin
