#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace twin::pictures::video {

/// What a video is made from.
struct VideoInput {
  std::filesystem::path trace_csv;  ///< trace of a run, or of a plan
  std::filesystem::path scene_xml;  ///< MJCF scene with the table
  std::filesystem::path output;     ///< MP4 file
  std::string title = {};           ///< first line of the read-out
  std::string camera = "iso";       ///< camera of the scene, or "follow"
  int width = 1280;                 ///< even [pixels]
  int height = 720;                 ///< even [pixels]
  int frames_per_second = 30;       ///< [frames/s]
  std::function<void(double)> progress =
      {};  ///< called with the part that is done, 0 to 1; may be empty
};

/// What was made.
struct VideoReport {
  int frames = 0;
  double duration = 0.0;   ///< of the video [s]: the machining time to the nearest frame
  double wall_time = 0.0;  ///< that it took [s]
};

/// Renders a trace offscreen as H.264 video in MP4: the table moves, the pen draws its trace in the
/// colours of the contour error over the commanded path, beside it feedrate, time, NC line and a
/// magnified drawing, under it feedrate and error over time. The camera stands so that the program
/// fills the picture; "follow" goes along with the plate. Frame i
/// shows the instant i / frames_per_second, the last one the end. The trace is streamed; memory
/// does not depend on its length. Written whole or not at all.
///
/// Renderer and encoder, with OpenGL and FFmpeg behind them, are in the module twin-video.so. The
/// first call loads it: from lib/twin beside the program or the library that holds this function,
/// then from where the project was built or installed. Thread-safe.
///
/// @returns a kFile error that names the places searched when there is no module
Expected<VideoReport> write_video(const VideoInput& input);

/// Places where twin-video.so is looked for, in their order.
std::vector<std::filesystem::path> video_module_places();

/// The same as write_video() with the module in this file. @returns a kFile error with the loader's
/// words when it cannot be loaded
Expected<VideoReport> write_video_with(const std::filesystem::path& module,
                                       const VideoInput& input);

}  // namespace twin::pictures::video
