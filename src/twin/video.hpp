#pragma once

#include <functional>
#include <string>

#include "twin/export.hpp"
#include "twin/settings.hpp"

namespace twin {

/// How a video is rendered.
struct VideoOptions {
  std::string camera = "iso";              ///< camera of the scene: "iso" or "top"
  std::string title{};                     ///< first line of the read-out; empty: the program
  std::function<void(double)> progress{};  ///< gets the done share, 0 to 1; may be empty
};

/// Renders FOLDER/video.mp4 from what a run has left in a folder, trace and summary.json: the
/// table moves as long as it did, the pen draws its trace in the colours of the contour error. The
/// video is written whole or not at all.
///
/// No display is needed. The first call loads the module twin-video.so, and with it OpenGL and
/// FFmpeg.
///
/// @param folder    RunOptions::folder of a run
/// @param settings  those of the run: they name the model of the table
/// @throws Failure if the folder is not that of a run, or the video cannot be rendered or written
TWIN_EXPORT void render_video(const std::string& folder, const Settings& settings,
                              const VideoOptions& options = {});

}  // namespace twin
