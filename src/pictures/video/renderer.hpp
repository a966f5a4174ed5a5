#pragma once

#include <filesystem>

#include "core/error.hpp"
#include "pictures/video/video.hpp"

namespace twin::pictures::video {

/// What write_video() does, in the module itself.
Expected<VideoReport> render_video(const VideoInput& input);

/// One frame of the video as PNG. @param t  instant [s]; beyond the end: the finished drawing
Expected<void> write_still(const VideoInput& input, double t, const std::filesystem::path& png);

}  // namespace twin::pictures::video
