#include <gmock/gmock.h>

#include "tests/support/files.hpp"
#include "tests/support/temp_folder.hpp"
#include "twin/twin.hpp"

namespace twin {
namespace library_shadow_test {

const char* const kTriangle = "G21 G90\nG1 X8 Y3 F3000\nY9\nX0 Y0\nM30\n";

TEST(Compensation, ARunFollowsItsFileAndRefusesThatOfAnotherProgram) {
  const test::TempFolder folder;
  const std::string file = (folder / "c.csv").string();
  const Settings settings;
  const Program program = Program::from_text(kTriangle);
  const Compensation made = compensate(program, settings, file);
  EXPECT_LT(made.max_after, 0.6 * made.max_before);
  const auto error_of = [&](const RunOptions& options) {
    return run(program, settings, *make_table(settings), options)
        .summary.number("contour_error_um.rms");
  };
  EXPECT_LT(error_of({.correction = file}), 0.9 * error_of({}));
  const Program other = Program::from_text("G21 G90\nG1 X8 F3000\nM30\n");
  EXPECT_THROW(run(other, settings, *make_table(settings), {.correction = file}), Failure);
}

TEST(Compensation, ALearntRunLeavesACorrectionForTheNextAndTakesNoOverride) {
  const test::TempFolder folder;
  const std::string learning = (folder / "learnt").string();
  const Settings settings;
  const Program program = Program::from_text(kTriangle);
  ASSERT_FALSE(run(program, settings, *make_table(settings), {.learning = learning}).failure);
  EXPECT_THAT(test::content(folder / "learnt" / "learnt.csv"),
              testing::StartsWith("# twin learnt 1, runs = 1"));
  const RunOptions slowed{.overrides = {{0.1, 50.0}}, .learning = learning};
  EXPECT_THROW(run(program, settings, *make_table(settings), slowed), Failure);
}

TEST(ShadowedRun, SaysWhatItSawAndRefusesAMachineWithoutDrives) {
  const test::TempFolder folder;
  const Settings settings;
  const Program program = Program::from_text(kTriangle);
  const twin::Run seen = run(program, settings, *make_table(settings),
                             {.folder = (folder / "run").string(), .has_shadow = true});
  ASSERT_TRUE(seen.shadow);
  EXPECT_TRUE(seen.shadow->findings.empty());
  EXPECT_EQ(test::content(folder / "run" / "shadow.json"), seen.shadow->json);
  EXPECT_THROW(run(program, settings, *make_ideal(), {.has_shadow = true}), Failure);
}

}  // namespace library_shadow_test
}  // namespace twin
