#pragma once

#include <filesystem>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "results/metrics/moving_rms.hpp"
#include "results/trace/program_zero.hpp"
#include "results/trace/trace_reader.hpp"

namespace twin::pictures::video {

/// What the video shows of one row of a trace.
struct TraceRow {
  double t = 0.0;                 ///< [s]
  double line = 0.0;              ///< NC line
  Vec3 position = Vec3::Zero();   ///< pen on the plate: table x and y, set point z above
                                  ///< the program's Z0 [mm]
  double feedrate = 0.0;          ///< [mm/s]
  double error_um = 0.0;          ///< contour error [um]; 0 in a plan
  double error_rms_um = 0.0;      ///< its root mean square over the last 0.1 s [um]
  Vec2 commanded = Vec2::Zero();  ///< set point [mm]; the position where the trace has none
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
  results::ProgramZero zero_;
  results::MovingRms rms_;
  bool has_error_ = false;
  bool has_commanded_ = false;
};

}  // namespace twin::pictures::video
