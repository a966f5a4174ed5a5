#pragma once

#include "core/error.hpp"
#include "pictures/video/video.hpp"

namespace twin::pictures::video {

/// Type and name of the one function that twin-video.so shows.
///
/// @param report  gets what render_video() returns
using RenderVideo = void (*)(const VideoInput* input, Expected<VideoReport>* report);
inline constexpr const char* kRenderVideoName = "twin_render_video";

}  // namespace twin::pictures::video
