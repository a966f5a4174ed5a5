#pragma once

#include <filesystem>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "results/trace/trace_reader.hpp"

namespace twin::pictures::video {

/// What the video shows of one row of a trace.
struct TraceRow {
  double t = 0.0;                ///< [s]
  double line = 0.0;             ///< NC line
  Vec3 position = Vec3::Zero();  ///< pen on the plate: table x and y, set point z [mm]
  double feedrate = 0.0;         ///< [mm/s]
  double error_um = 0.0;         ///< contour error [um]; 0 in a plan
};

/// Streams the rows of a trace; that of a plan stands for a table that follows exactly.
class TraceRows {
 public:
  static Expected<TraceRows> open(const std::filesystem::path& trace_csv);

  /// @returns false when there is no further row
  Expected<bool> next(TraceRow& row);
  bool has_error() const noexcept { return has_error_; }  ///< the trace has contour errors

 private:
  explicit TraceRows(results::TraceReader&& reader) : reader_(std::move(reader)) {}

  results::TraceReader reader_;
  bool has_error_ = false;
};

/// What must be known of a trace before its first frame.
struct Survey {
  double duration = 0.0;          ///< time of the last row [s]
  bool has_error = false;         ///< the trace has contour errors
  double largest_error_um = 0.0;  ///< where the pen draws [um]
  Vec2 low = Vec2::Zero();        ///< corner of the drawing's bounding box [mm]
  Vec2 high = Vec2::Zero();       ///< its opposite corner [mm]
  double pen_up = 0.0;            ///< height above which the pen does not draw [mm]
};

/// Reads a whole trace once, in bounded memory. An empty trace is an error.
Expected<Survey> survey_trace(const std::filesystem::path& trace_csv);

}  // namespace twin::pictures::video
