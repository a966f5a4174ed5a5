#pragma once

#include <filesystem>
#include <memory>

#include "core/error.hpp"
#include "pictures/video/image.hpp"

namespace twin::pictures::video {

/// H.264 in MP4, encoded in this process by FFmpeg's libraries; the index stands in front for
/// players on the web.
///
/// Frames go to "NAME.tmp"; finish() renames it. Without finish() nothing is left.
class VideoEncoder {
 public:
  /// @param width,height       size of the frames, even [pixels]
  /// @param frames_per_second  at least 1
  static Expected<VideoEncoder> open(const std::filesystem::path& output, int width, int height,
                                     int frames_per_second);
  VideoEncoder(VideoEncoder&&) noexcept;
  VideoEncoder& operator=(VideoEncoder&&) noexcept;
  ~VideoEncoder();

  Expected<void> push(const Image& frame);
  Expected<void> finish();

 private:
  struct Parts;
  explicit VideoEncoder(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

/// Writes a picture as PNG, whole or not at all.
Expected<void> write_png(const Image& image, const std::filesystem::path& output);

}  // namespace twin::pictures::video
