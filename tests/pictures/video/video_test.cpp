#include "pictures/video/renderer.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

#include "pictures/video/av.hpp"
#include "pictures/video/film.hpp"
#include "pictures/video/video_encoder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic_trace.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::pictures::video {
namespace video_test {

namespace fs = std::filesystem;
using test::SyntheticRun;
using test::TempFolder;

const fs::path kScene = fs::path(TWIN_SOURCE_DIR) / "mjcf" / "scene.xml";

/// What a player finds in a file.
struct Played {
  int frames = 0;
  int width = 0;
  int height = 0;
  double duration = 0.0;    // [s]
  double frame_time = 0.0;  // of the second frame [s]
  int darkest = 255;        // of all frames' brightness
  int brightest = 0;
};

void look_at(const AVFrame& frame, Played& played) {
  ++played.frames;
  played.width = frame.width;
  played.height = frame.height;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const int value = frame.data[0][y * frame.linesize[0] + x];
      played.darkest = std::min(played.darkest, value);
      played.brightest = std::max(played.brightest, value);
    }
  }
}

/// Decodes a whole file.
Played play(const fs::path& file) {
  Played played;
  AVFormatContext* format = nullptr;
  if (avformat_open_input(&format, file.c_str(), nullptr, nullptr) < 0) {
    return played;
  }
  avformat_find_stream_info(format, nullptr);
  const AVStream& stream = *format->streams[0];
  played.duration = static_cast<double>(stream.duration) * av_q2d(stream.time_base);
  const AVCodec* const decoder = avcodec_find_decoder(stream.codecpar->codec_id);
  const av::Owner<AVCodecContext> codec(avcodec_alloc_context3(decoder));
  avcodec_parameters_to_context(codec.get(), stream.codecpar);
  avcodec_open2(codec.get(), decoder, nullptr);
  const av::Owner<AVFrame> frame(av_frame_alloc());
  const av::Owner<AVPacket> packet(av_packet_alloc());
  bool is_more = true;
  while (is_more) {
    is_more = av_read_frame(format, packet.get()) >= 0;
    avcodec_send_packet(codec.get(), is_more ? packet.get() : nullptr);
    while (avcodec_receive_frame(codec.get(), frame.get()) >= 0) {
      look_at(*frame, played);
    }
    av_packet_unref(packet.get());
  }
  avformat_close_input(&format);
  return played;
}

VideoInput small_video(const fs::path& directory, double duration) {
  SyntheticRun run;
  run.duration = duration;
  run.radius = 60.0;
  EXPECT_TRUE(test::write_synthetic_trace(directory, run));
  VideoInput input;
  input.trace_csv = directory / "trace.csv";
  input.scene_xml = kScene;
  input.output = directory / "video.mp4";
  input.title = "trefoil";
  input.width = 320;
  input.height = 180;
  return input;
}

TEST(VideoEncoder, WhatIsEncodedPlaysWithEveryFrame) {
  const TempFolder directory;
  const fs::path file = directory.path() / "odd: name.mp4";
  auto encoder = VideoEncoder::open(file, 64, 48, 25);
  ASSERT_TRUE(encoder) << to_string(encoder.error());
  for (int i = 0; i < 60; ++i) {
    const auto grey = static_cast<std::uint8_t>(4 * i);
    ASSERT_TRUE(encoder->push(Image(64, 48, {grey, grey, grey})));
  }
  EXPECT_FALSE(fs::exists(file));
  ASSERT_TRUE(encoder->finish());
  const Played played = play(file);
  EXPECT_EQ(played.frames, 60);
  EXPECT_EQ(played.width, 64);
  EXPECT_EQ(played.height, 48);
  EXPECT_NEAR(played.duration, 60.0 / 25.0, 1e-6);
  EXPECT_NEAR(played.darkest, 16, 2);  // limited range: black is 16
  EXPECT_NEAR(played.brightest, 16 + 236 * 219 / 255, 3);
}

TEST(VideoEncoder, WithoutFinishNothingIsLeft) {
  const TempFolder directory;
  {
    auto encoder = VideoEncoder::open(directory.path() / "v.mp4", 64, 48, 25);
    ASSERT_TRUE(encoder);
    ASSERT_TRUE(encoder->push(Image(64, 48)));
  }
  EXPECT_TRUE(fs::is_empty(directory.path()));
}

TEST(VideoEncoder, OddSizesAndUnwritableFilesAreRefused) {
  EXPECT_EQ(VideoEncoder::open("/tmp/v.mp4", 63, 48, 25).error().code, ErrorCode::kUsage);
  const auto encoder = VideoEncoder::open("/nonexistent/v.mp4", 64, 48, 25);
  ASSERT_FALSE(encoder);
  EXPECT_EQ(to_string(encoder.error()),
            "/nonexistent/v.mp4: cannot write: No such file or directory");
}

TEST(VideoEncoder, AFullDiskIsAnErrorAndLeavesNoFile) {
  const TempFolder directory;
  {
    auto encoder = VideoEncoder::open(directory.path() / "v.mp4", 640, 480, 25);
    ASSERT_TRUE(encoder);
    const test::FileSizeLimit limit(20000);
    Image noise(640, 480);
    Expected<void> done;
    for (int i = 0; i < 100 && done; ++i) {
      for (int k = 0; k < 640 * 480 * 3; ++k) {
        noise.data()[k] = static_cast<std::uint8_t>(
            (static_cast<unsigned>(k) * 7919U + static_cast<unsigned>(i) * 104729U) >> 5U);
      }
      done = encoder->push(noise);
    }
    if (done) {
      done = encoder->finish();
    }
    ASSERT_FALSE(done);
    EXPECT_THAT(to_string(done.error()), testing::HasSubstr("cannot write: File too large"));
  }
  EXPECT_TRUE(fs::is_empty(directory.path()));
}

TEST(Png, APictureReadsBackPixelForPixel) {
  const TempFolder directory;
  Image image(31, 17);
  for (int y = 0; y < 17; ++y) {
    for (int x = 0; x < 31; ++x) {
      image.mix(x, y, {static_cast<std::uint8_t>(8 * x), static_cast<std::uint8_t>(15 * y), 77},
                1.0);
    }
  }
  ASSERT_TRUE(write_png(image, directory.path() / "a.png"));
  AVFormatContext* format = nullptr;
  ASSERT_GE(avformat_open_input(&format, (directory.path() / "a.png").c_str(), nullptr, nullptr),
            0);
  const AVCodec* const decoder = avcodec_find_decoder(AV_CODEC_ID_PNG);
  const av::Owner<AVCodecContext> codec(avcodec_alloc_context3(decoder));
  ASSERT_GE(avcodec_open2(codec.get(), decoder, nullptr), 0);
  const av::Owner<AVFrame> frame(av_frame_alloc());
  const av::Owner<AVPacket> packet(av_packet_alloc());
  ASSERT_GE(av_read_frame(format, packet.get()), 0);
  ASSERT_GE(avcodec_send_packet(codec.get(), packet.get()), 0);
  ASSERT_GE(avcodec_receive_frame(codec.get(), frame.get()), 0);
  ASSERT_EQ(frame->width, 31);
  ASSERT_EQ(frame->height, 17);
  for (int y = 0; y < 17; ++y) {
    EXPECT_TRUE(
        std::equal(image.row(y), image.row(y) + 93, frame->data[0] + y * frame->linesize[0]));
  }
  avformat_close_input(&format);
}

TEST(Video, ItIsAsLongAsTheMachiningToTheNearestFrame) {
  const TempFolder directory;
  VideoInput input = small_video(directory.path(), 0.42);
  std::vector<double> progress;
  input.progress = [&](double part) { progress.push_back(part); };
  const auto report = render_video(input);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->frames, 13);  // 0.42 s x 30 frames/s = 12.6
  const Played played = play(input.output);
  EXPECT_EQ(played.frames, 13);
  EXPECT_EQ(played.width, 320);
  EXPECT_EQ(played.height, 180);
  EXPECT_NEAR(played.duration, 0.42, 1.0 / 30.0);
  EXPECT_LT(played.darkest, 80);
  EXPECT_GT(played.brightest, 180);
  EXPECT_THAT(progress, testing::SizeIs(13));
  EXPECT_EQ(progress.back(), 1.0);
  EXPECT_FALSE(fs::exists(input.output.string() + ".tmp"));
}

/// Number of pixels in which two pictures differ clearly.
int differences(const Image& a, const Image& b) {
  int count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      count += std::abs(a.at(x, y)[1] - b.at(x, y)[1]) > 25 ? 1 : 0;
    }
  }
  return count;
}

TEST(Film, AClosedPathLeavesItsDrawingOnThePlateAndNothingElse) {
  const TempFolder directory;
  const VideoInput input = small_video(directory.path(), 0.5);
  auto film = Film::create(input.trace_csv, kScene, "top", 320, 180, 0);
  ASSERT_TRUE(film) << to_string(film.error());
  const auto start = film->shoot(0.0);
  const auto middle = film->shoot(0.25);
  const auto end = film->shoot(film->duration());
  ASSERT_TRUE(start && middle && end);
  // The table is back where it was: what differs is ink.
  EXPECT_GT(differences(start->frame, end->frame), 50);
  EXPECT_LT(differences(start->frame, end->frame), 320 * 180 / 20);
  // Half way the table is elsewhere.
  EXPECT_GT(differences(start->frame, middle->frame), differences(start->frame, end->frame));
  EXPECT_GT(differences(start->readout.inset, end->readout.inset), 200);
}

TEST(Film, ThePaperBehindThePenChangesToInk) {
  const TempFolder directory;
  const VideoInput input = small_video(directory.path(), 0.5);
  auto film = Film::create(input.trace_csv, kScene, "top", 320, 180, 0);
  ASSERT_TRUE(film);
  const auto early = film->shoot(0.001);
  const auto late = film->shoot(0.5);
  ASSERT_TRUE(early && late);
  const int x = static_cast<int>(late->readout.pen.x());
  const int y = static_cast<int>(late->readout.pen.y());
  // The path starts upwards and comes back from below: there only the finished drawing has ink.
  const auto darkest_below = [&](const Shot& shot) {
    int darkest = 255;
    for (int dx = -2; dx <= 2; ++dx) {
      darkest = std::min<int>(darkest, shot.readout.inset.at(x + dx, y + 6)[1]);
    }
    return darkest;
  };
  EXPECT_GT(darkest_below(*early), 240);
  EXPECT_LT(darkest_below(*late), 160);
}

TEST(Video, AStillIsAPngOfTheSizeAskedFor) {
  const TempFolder directory;
  const VideoInput input = small_video(directory.path(), 0.1);
  const auto written = write_still(input, 1e9, directory.path() / "still.png");
  ASSERT_TRUE(written) << to_string(written.error());
  const std::string bytes = test::content(directory.path() / "still.png");
  ASSERT_GT(bytes.size(), 10000U);
  EXPECT_EQ(bytes.substr(16, 8), std::string("\0\0\x01\x40\0\0\0\xB4", 8));  // 320 x 180
}

/// The error of a video with one thing wrong; no file may be left.
std::string complaint(VideoInput input) {
  const auto report = render_video(input);
  EXPECT_FALSE(fs::exists(input.output));
  EXPECT_FALSE(fs::exists(input.output.string() + ".tmp"));
  return report ? "" : to_string(report.error());
}

TEST(Video, WrongInputIsNamedAndLeavesNoFile) {
  const TempFolder directory;
  const VideoInput good = small_video(directory.path(), 0.1);
  VideoInput bad = good;
  bad.camera = "behind";
  EXPECT_THAT(complaint(bad), testing::HasSubstr("behind"));
  bad = good;
  bad.scene_xml = directory.path() / "none.xml";
  EXPECT_THAT(complaint(bad), testing::HasSubstr("none.xml"));
  bad.scene_xml = directory.path() / "empty.xml";
  test::put(bad.scene_xml, "<mujoco/>");
  EXPECT_THAT(complaint(bad), testing::HasSubstr("joint"));
  bad = good;
  bad.trace_csv = directory.path() / "none.csv";
  EXPECT_THAT(complaint(bad), testing::HasSubstr("none.csv: cannot open"));
  bad.trace_csv = directory.path() / "bad.csv";
  test::put(bad.trace_csv, "t_s,line\n0,1\n");
  EXPECT_THAT(complaint(bad), testing::HasSubstr("no column"));
}

}  // namespace video_test
}  // namespace twin::pictures::video
