#pragma once

#include <filesystem>

#include "core/error.hpp"
#include "pictures/video/video.hpp"

namespace twin::pictures::video {

/// What write_video() does, in the module itself.
Expected<VideoReport> render_video(const VideoInput& input);

/// One frame of the video as PNG. @param t  instant [s]; beyond the end: the finished drawing
Expected<void> write_still(const VideoInput& input, double t, const std::filesystem::path& png);

/// Type and name of the one function that twin-video.so shows.
///
/// @param report  gets what render_video() returns
using RenderVideo = void (*)(const VideoInput* input, Expected<VideoReport>* report);
inline constexpr const char* kRenderVideoName = "twin_render_video";

}  // namespace twin::pictures::video
