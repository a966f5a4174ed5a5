#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/error.hpp"

namespace twin::pictures::video {

/// What a video is made from.
struct VideoInput {
  std::filesystem::path trace_csv;  ///< trace of a run, or of a plan
  std::filesystem::path scene_xml;  ///< MJCF scene with the table
  std::filesystem::path output;     ///< MP4 file
  std::string title = {};           ///< first line of the read-out
  std::string camera = "iso";       ///< camera of the scene
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
/// colours of the contour error, beside it feedrate, time, NC line and a magnified drawing. Frame i
/// shows the instant i / frames_per_second, the last one the end. The trace is streamed; memory
/// does not depend on its length. Written whole or not at all.
Expected<VideoReport> write_video(const VideoInput& input);

/// One frame of the video as PNG. @param t  instant [s]; beyond the end: the finished drawing
Expected<void> write_still(const VideoInput& input, double t, const std::filesystem::path& png);

}  // namespace twin::pictures::video
