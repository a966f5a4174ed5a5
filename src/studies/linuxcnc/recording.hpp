#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "hal/linuxcnc/segment.h"
#include "results/trace/columns.hpp"
#include "results/trace/csv_trace.hpp"
#include "results/trace/sample.hpp"

namespace twin::studies::linuxcnc {

/// One period of a plant behind LinuxCNC as a sample: set points in the coordinates of the joints,
/// and in the same coordinates what encoders and table show.
///
///   encoder = counts c - o,   table = true position - o
///
/// with the encoder scale c and the offset o that homing and index marks have made. A set point that
/// no signal tells is where the encoder is.
results::Sample sample_of(const twin_segment& memory) noexcept;

/// Columns of a recording: what a plant knows without the program.
results::ColumnChoice recording_columns();

/// Traces of what LinuxCNC has done with a plant, a folder for each time that it was to be recorded:
/// DIR/001, DIR/002, ...
///
/// A recording has up to a third of a second before it as well, so that a signal which comes a
/// little late loses nothing; but not a motion that had come to rest before.
class Recordings {
 public:
  /// @param folder  of the folders  @param period  of the plant [s]
  Recordings(std::filesystem::path folder, double period);

  /// Takes a period. It begins a recording where the component says so, and ends one.
  Expected<void> take(const twin_segment& memory);
  /// Ends a recording that goes on.
  Expected<void> end();

  /// Folders of the recordings that have ended.
  const std::vector<std::filesystem::path>& folders() const noexcept { return folders_; }

 private:
  Expected<void> begin();
  void forget_earlier_motion();
  Expected<void> write(const results::Sample& sample);
  Expected<void> flush();

  std::filesystem::path folder_;
  double period_;  // [s]
  results::ColumnChoice columns_;
  std::deque<results::Sample> before_;  // of the recording that may come
  std::optional<results::CsvTrace> trace_;
  std::filesystem::path current_;  // folder of trace_
  std::vector<double> rows_;       // not written yet (rows x columns)
  std::int64_t written_ = 0;       // rows of this recording
  Vec3 last_ = Vec3::Zero();       // set point [mm]
  std::vector<std::filesystem::path> folders_;
};

}  // namespace twin::studies::linuxcnc
