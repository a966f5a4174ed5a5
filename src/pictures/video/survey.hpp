#pragma once

#include <filesystem>

#include "pictures/video/history.hpp"

namespace twin::pictures::video {

/// What must be known of a trace before its first frame.
struct Survey {
  double duration = 0.0;          ///< time of the last row [s]
  bool has_error = false;         ///< the trace has contour errors
  double largest_error_um = 0.0;  ///< where the pen draws [um]
  double largest_rms_um = 0.0;    ///< of the moving root mean square there [um]
  Vec2 low = Vec2::Zero();        ///< corner of the drawing's bounding box [mm]
  Vec2 high = Vec2::Zero();       ///< its opposite corner [mm]
  double pen_up = 0.0;            ///< height above which the pen does not draw [mm]
  History history;                ///< feedrate and contour error over time
};

/// Reads a whole trace once, in bounded memory. An empty trace is an error.
Expected<Survey> survey_trace(const std::filesystem::path& trace_csv);

}  // namespace twin::pictures::video
