#include "twin/video.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <vector>

#include "tests/support/files.hpp"
#include "tests/support/temp_folder.hpp"
#include "twin/twin.hpp"

namespace twin {
namespace video_test {

/// The error that rendering throws.
Error failure_of(const std::string& folder, const VideoOptions& options = {}) {
  try {
    render_video(folder, Settings(), options);
  } catch (const Failure& failure) {
    return failure.error();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(Video, AShortRunIsRenderedBesideItsTrace) {
  const test::TempFolder folder;
  const Settings settings;
  const Program program = Program::from_text("G21 G90\nG1 X1 F1200\nM30\n", "short.nc");
  const twin::Run result =
      run(program, settings, *make_table(settings), {.folder = folder.path().string()});
  ASSERT_FALSE(result.failure);
  std::vector<double> shares;
  render_video(folder.path().string(), settings,
               {.camera = "top", .progress = [&](double share) { shares.push_back(share); }});
  const std::string video = test::content(folder / "video.mp4");
  ASSERT_GT(video.size(), 1000U);
  EXPECT_EQ(video.substr(4, 4), "ftyp");  // the first box of an MP4 file
  ASSERT_FALSE(shares.empty());
  EXPECT_EQ(shares.back(), 1.0);
  EXPECT_THAT(to_string(failure_of(folder.path().string(), {.camera = "none"})),
              testing::HasSubstr("none"));
}

TEST(Video, AFolderThatIsNotThatOfARunIsRefused) {
  const test::TempFolder folder;
  const Error error = failure_of(folder.path().string());
  EXPECT_EQ(error.code, ErrorCode::kFile);
  EXPECT_THAT(to_string(error), testing::HasSubstr("is this the folder of a run?"));
  EXPECT_FALSE(std::filesystem::exists(folder / "video.mp4"));
}

}  // namespace video_test
}  // namespace twin
