#include "pictures/video/renderer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <optional>
#include <thread>
#include <utility>

#include "core/bounded_queue.hpp"
#include "hal/mujoco/mujoco_library.hpp"
#include "pictures/video/film.hpp"
#include "pictures/video/video_encoder.hpp"

namespace twin::pictures::video {
namespace {

constexpr int kVideoSamples = 0;  // smooth edges would take the video below half of real time
constexpr int kStillSamples = 4;
constexpr std::size_t kFramesAhead = 3;  // between renderer and encoder

/// Calls a function; what MuJoCo throws becomes an Error.
template <class Function>
auto guarded(const Function& function) -> decltype(function()) {
  try {
    return function();
  } catch (const hal::mujoco::MujocoError& error) {
    return fail(ErrorCode::kModel, std::string("MuJoCo cannot draw the scene: ") + error.what());
  }
}

/// Overlay and encoding in a thread of their own, beside the renderer.
class EncoderThread {
 public:
  EncoderThread(Overlay overlay, VideoEncoder encoder)
      : overlay_(std::move(overlay)), encoder_(std::move(encoder)), thread_([this] { work(); }) {}
  EncoderThread(const EncoderThread&) = delete;
  EncoderThread& operator=(const EncoderThread&) = delete;
  ~EncoderThread() { queue_.close(); }

  /// @returns false when the encoder has failed; finish() says why
  bool push(Shot shot) { return queue_.push(std::move(shot)); }

  /// Waits for the last frame and closes the file.
  Expected<void> finish() {
    queue_.close();
    thread_.join();
    return result_.and_then([this] { return encoder_.finish(); });
  }

 private:
  void work() {
    try {
      encode();
    } catch (const std::exception& error) {
      result_ = fail(ErrorCode::kFile, std::string("the video cannot be made: ") + error.what());
      queue_.close();
    }
  }

  void encode() {
    while (auto shot = queue_.pop()) {
      overlay_.draw(shot->frame, shot->readout);
      result_ = encoder_.push(shot->frame);
      if (!result_) {
        queue_.close();
        return;
      }
    }
  }

  Overlay overlay_;
  VideoEncoder encoder_;
  BoundedQueue<Shot> queue_{kFramesAhead};
  Expected<void> result_;  // of the thread; read after it has ended
  std::jthread thread_;    // last: it uses all of the above
};

Expected<VideoReport> make_video(const VideoInput& input) {
  const auto start = std::chrono::steady_clock::now();
  TWIN_TRY(VideoEncoder encoder,
           VideoEncoder::open(input.output, input.width, input.height, input.frames_per_second));
  TWIN_TRY(Film film, Film::create(input.trace_csv, input.scene_xml, input.camera, input.width,
                                   input.height, kVideoSamples));
  const double rate = input.frames_per_second;
  const int frames = std::max(1, static_cast<int>(std::lround(film.duration() * rate)));
  EncoderThread thread(film.make_overlay(input.title), std::move(encoder));
  for (int i = 0; i < frames; ++i) {
    TWIN_TRY(Shot shot, film.shoot(i == frames - 1 ? film.duration() : i / rate));
    if (!thread.push(std::move(shot))) {
      break;
    }
    if (input.progress) {
      input.progress(static_cast<double>(i + 1) / frames);
    }
  }
  TWIN_CHECK(thread.finish());
  const std::chrono::duration<double> wall_time = std::chrono::steady_clock::now() - start;
  return VideoReport{frames, frames / rate, wall_time.count()};
}

}  // namespace

Expected<VideoReport> render_video(const VideoInput& input) {
  return guarded([&] { return make_video(input); });
}

Expected<void> write_still(const VideoInput& input, double t, const std::filesystem::path& png) {
  return guarded([&]() -> Expected<void> {
    TWIN_TRY(Film film, Film::create(input.trace_csv, input.scene_xml, input.camera, input.width,
                                     input.height, kStillSamples));
    const Overlay overlay = film.make_overlay(input.title);
    TWIN_TRY(Shot shot, film.shoot(t));
    overlay.draw(shot.frame, shot.readout);
    return write_png(shot.frame, png);
  });
}

}  // namespace twin::pictures::video
