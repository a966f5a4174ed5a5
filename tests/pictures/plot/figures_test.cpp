#include "pictures/plot/figures.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "results/trace/limit_writer.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic_trace.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::pictures {
namespace figures_test {

namespace fs = std::filesystem;
using test::SyntheticRun;
using test::TempFolder;

/// Width and height from the header of a PNG file; zero for anything else.
std::pair<unsigned, unsigned> png_size(const fs::path& file) {
  const std::string bytes = test::content(file);
  if (bytes.size() < 24 || bytes.substr(0, 8) != "\x89PNG\r\n\x1a\n") {
    return {0, 0};
  }
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = at; i < at + 4; ++i) {
      value = value * 256 + static_cast<unsigned char>(bytes[i]);
    }
    return value;
  };
  return {number(16), number(20)};
}

TEST(Figures, ARunHasAllFiguresWithDataAndScriptBeside) {
  const TempFolder directory;
  const SyntheticRun run;
  ASSERT_TRUE(test::write_synthetic_trace(directory.path(), run));
  const auto pictures =
      write_figures({directory.path(), "trefoil", test::synthetic_path(run), false});
  ASSERT_TRUE(pictures) << to_string(pictures.error());
  EXPECT_EQ(pictures->size(), 12U);
  for (const std::string name : {"contour", "contour_magnified", "feedrate", "acceleration_jerk",
                                 "contour_error", "tracking_errors"}) {
    const fs::path base = directory.path() / "plots" / name;
    EXPECT_EQ(png_size(base.string() + ".png"), std::pair(1200U, 900U)) << name;
    EXPECT_GT(fs::file_size(base.string() + ".png"), 10000U) << name;
    EXPECT_THAT(test::content(base.string() + ".svg"), testing::HasSubstr("</svg>")) << name;
    EXPECT_GT(fs::file_size(base.string() + ".csv"), 10000U) << name;
    EXPECT_TRUE(fs::exists(base.string() + ".gp")) << name;
  }
}

TEST(Figures, APaperHasAPdfOfOneColumnWithoutTitle) {
  const TempFolder directory;
  SyntheticRun run;
  run.duration = 0.2;
  ASSERT_TRUE(test::write_synthetic_trace(directory.path(), run));
  FigureInput input{directory.path(), "trefoil", {}, true};
  input.paper = Paper::kToo;
  const auto pictures = write_figures(input);
  ASSERT_TRUE(pictures) << to_string(pictures.error());
  EXPECT_EQ(pictures->size(), 9U);
  const fs::path pdf = directory.path() / "plots/feedrate.pdf";
  const std::string text = test::content(pdf);
  const std::size_t box = text.find("/MediaBox [ 0 0 ");
  ASSERT_NE(box, std::string::npos);
  EXPECT_NEAR(std::strtod(text.c_str() + box + 16, nullptr), 86.0 / 25.4 * 72.0, 1.5);  // [points]
  EXPECT_NE(text.find("/CreationDate (D:19700101000000"), std::string::npos);
  // The next drawing is not for a paper, and leaves no PDF of this one.
  ASSERT_TRUE(write_figures({directory.path(), "trefoil", {}, true}));
  EXPECT_FALSE(fs::exists(pdf));
}

TEST(Figures, TheLineBelowTheTitleHasTheSettingsOfTheRun) {
  const TempFolder directory;
  SyntheticRun run;
  run.duration = 0.2;
  ASSERT_TRUE(test::write_synthetic_trace(directory.path(), run));
  std::ofstream(directory.path() / "summary.json") << R"({"planner": "certified", "settings": {
      "limits": {"acceleration_mm_per_s2": 2450.0, "jerk_mm_per_s3": 50000.0},
      "planning": {"chord_error_mm": 0.01}}})";
  ASSERT_TRUE(write_figures({directory.path(), "trefoil", {}, true}));
  EXPECT_THAT(
      test::content(directory.path() / "plots/feedrate.gp"),
      testing::HasSubstr("'certified planner, at most 2450 mm/s² and 50·10³ mm/s³, within 10 µm'"));
}

TEST(Figures, ARunOnTheWallClockHasItsTimingAndSaysThatItIsSimulated) {
  const TempFolder directory;
  SyntheticRun run;
  run.duration = 0.2;
  ASSERT_TRUE(test::write_synthetic_trace(directory.path(), run));
  const fs::path plots = directory.path() / "plots";
  fs::create_directories(plots);
  std::ofstream(plots / "timing.csv")
      << "time_us,wake_up,compute,total\n1,0,5,0\n10,70,1,3\n100,2,0,90\n";
  std::ofstream(directory.path() / "summary.json")
      << R"({"simulated": true, "period_s": 0.001, "machining_time_s": 1.5})";
  auto pictures = write_figures({directory.path(), "trefoil", {}, false});
  ASSERT_TRUE(pictures) << to_string(pictures.error());
  EXPECT_EQ(pictures->size(), 14U);
  EXPECT_GT(fs::file_size(plots / "timing.png"), 10000U);
  EXPECT_THAT(test::content(plots / "timing.gp"), testing::HasSubstr("'trefoil, simulated'"));
  EXPECT_THAT(test::content(plots / "contour.gp"), testing::HasSubstr("'trefoil, simulated'"));
  // The next run does not keep to the wall clock, and moves metal.
  fs::remove(plots / "timing.csv");
  std::ofstream(directory.path() / "summary.json")
      << R"({"simulated": false, "period_s": 0.001, "machining_time_s": 1.5})";
  pictures = write_figures({directory.path(), "trefoil", {}, false});
  ASSERT_TRUE(pictures) << to_string(pictures.error());
  EXPECT_FALSE(fs::exists(plots / "timing.png"));
  EXPECT_THAT(test::content(plots / "contour.gp"), testing::Not(testing::HasSubstr("simulated")));
}

TEST(Figures, APlanHasTheFiguresOfTheCommand) {
  const TempFolder directory;
  SyntheticRun run;
  run.duration = 0.2;
  ASSERT_TRUE(test::write_synthetic_trace(directory.path(), run, results::Layout::kPlan));
  const auto pictures = write_figures({directory.path(), "", {}, true});
  ASSERT_TRUE(pictures) << to_string(pictures.error());
  EXPECT_EQ(pictures->size(), 6U);
}

TEST(Figures, AnOddDirectoryNameAndTitleDoNoHarm) {
  const TempFolder directory;
  const fs::path odd = directory.path() / "it's; touch $(x) \"y\"";
  fs::create_directory(odd);
  SyntheticRun run;
  run.duration = 0.2;
  ASSERT_TRUE(test::write_synthetic_trace(odd, run, results::Layout::kPlan));
  const auto pictures = write_figures({odd, "100 % o'clock {/:Bold x}_2 \\ \"", {}, true});
  EXPECT_TRUE(pictures) << to_string(pictures.error());
}

TEST(Figures, ATraceOfOneRowOrOfDescendingTimeIsRefused) {
  const TempFolder directory;
  const std::string header = "t_s,x_cmd_mm,y_cmd_mm,z_cmd_mm,feedrate_mm_per_s\n";
  test::put(directory.path() / "trace.csv", header + "0,0,0,0,0\n");
  auto pictures = write_figures({directory.path(), "", {}, true});
  ASSERT_FALSE(pictures);
  EXPECT_THAT(to_string(pictures.error()), testing::HasSubstr("fewer than two rows"));
  test::put(directory.path() / "trace.csv", header + "1,0,0,0,0\n1,0,0,0,0\n");
  pictures = write_figures({directory.path(), "", {}, true});
  ASSERT_FALSE(pictures);
  EXPECT_THAT(to_string(pictures.error()), testing::HasSubstr("trace.csv:3:1: t_s 1 s does not"));
}

/// Puts another search path into the environment while it lives.
class SearchPath {
 public:
  explicit SearchPath(const std::string& path) : before_(std::getenv("PATH")) {
    setenv("PATH", path.c_str(), 1);
  }
  SearchPath(const SearchPath&) = delete;
  SearchPath& operator=(const SearchPath&) = delete;
  ~SearchPath() { setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

TEST(Figures, WithoutGnuplotTheMessageSaysWhatToInstall) {
  const TempFolder directory;
  SyntheticRun run;
  run.duration = 0.1;
  ASSERT_TRUE(test::write_synthetic_trace(directory.path(), run, results::Layout::kPlan));
  const SearchPath path("/nonexistent");
  const auto pictures = write_figures({directory.path(), "", {}, true});
  ASSERT_FALSE(pictures);
  EXPECT_THAT(pictures.error().message, testing::HasSubstr("install package gnuplot-nox"));
}

TEST(Figures, AFailingGnuplotIsQuoted) {
  const TempFolder directory;
  SyntheticRun run;
  run.duration = 0.1;
  ASSERT_TRUE(test::write_synthetic_trace(directory.path(), run, results::Layout::kPlan));
  const fs::path fake = directory.path() / "gnuplot";
  test::put(fake, "#!/bin/sh\necho >&2\necho 'out of paper' >&2\nexit 3\n");
  fs::permissions(fake, fs::perms::owner_all);
  const SearchPath path(directory.path().string());
  const auto pictures = write_figures({directory.path(), "", {}, true});
  ASSERT_FALSE(pictures);
  EXPECT_EQ(pictures.error().message, "gnuplot failed: out of paper");
  EXPECT_FALSE(fs::exists(directory.path() / "plots" / "contour.png"));
}

}  // namespace figures_test
}  // namespace twin::pictures
