#include <gmock/gmock.h>

#include <filesystem>

#include "pictures/video/video.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic_trace.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::pictures::video {
namespace module_test {

namespace fs = std::filesystem;
using test::TempFolder;

VideoInput tiny_video(const fs::path& directory) {
  test::SyntheticRun run;
  run.duration = 0.1;
  EXPECT_TRUE(test::write_synthetic_trace(directory, run));
  VideoInput input;
  input.trace_csv = directory / "trace.csv";
  input.scene_xml = fs::path(TWIN_SOURCE_DIR) / "mjcf" / "scene.xml";
  input.output = directory / "video.mp4";
  input.width = 160;
  input.height = 90;
  return input;
}

TEST(VideoModule, ItIsFoundAndWritesAVideo) {
  const TempFolder directory;
  const VideoInput input = tiny_video(directory.path());
  const auto report = write_video(input);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->frames, 3);  // 0.1 s x 30 frames/s
  EXPECT_EQ(test::content(input.output).substr(4, 4), "ftyp");
}

TEST(VideoModule, ItsErrorsComeBack) {
  const TempFolder directory;
  VideoInput input = tiny_video(directory.path());
  input.camera = "behind";
  const auto report = write_video(input);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kModel);
  EXPECT_THAT(to_string(report.error()), testing::HasSubstr("behind"));
}

TEST(VideoModule, AMissingOneIsNamed) {
  const TempFolder directory;
  const auto report = write_video_with("/nowhere/twin-video.so", tiny_video(directory.path()));
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kFile);
  EXPECT_THAT(to_string(report.error()),
              testing::StartsWith("/nowhere/twin-video.so: the video's renderer cannot be loaded"));
}

TEST(VideoModule, AFileThatIsNoneIsNamed) {
  const TempFolder directory;
  test::put(directory.path() / "twin-video.so", "not a library");
  const auto report =
      write_video_with(directory.path() / "twin-video.so", tiny_video(directory.path()));
  ASSERT_FALSE(report);
  EXPECT_THAT(to_string(report.error()), testing::HasSubstr("cannot be loaded"));
}

TEST(VideoModule, ItIsLookedForBesideTheProgramFirst) {
  const std::vector<fs::path> places = video_module_places();
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
  EXPECT_EQ(places.front(), program / "twin" / "twin-video.so");
  EXPECT_THAT(places, testing::Contains(program.parent_path() / "lib" / "twin" / "twin-video.so"));
}

}  // namespace module_test
}  // namespace twin::pictures::video
