#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/limits.hpp"
#include "results/metrics/contour_tracker.hpp"
#include "results/metrics/error_figures.hpp"
#include "results/metrics/feedrate_fluctuation.hpp"
#include "results/metrics/limit_audit.hpp"
#include "results/metrics/log_histogram.hpp"
#include "results/metrics/summary.hpp"
#include "results/trace/columns.hpp"
#include "results/trace/csv_trace.hpp"
#include "results/trace/hdf5_trace.hpp"
#include "results/trace/limit_writer.hpp"
#include "results/trace/program_zero.hpp"
#include "results/trace/trace_files.hpp"
#include "runtime/cycle_timing.hpp"
#include "runtime/shared_blocks.hpp"
#include "runtime/trace_sinks.hpp"

namespace twin::runtime {

/// Turns the stream of samples into the rows of the trace and the figures of the summary, in
/// bounded memory.
///
/// For the contour error it goes through the program's blocks by itself, as far ahead of the
/// samples as it needs, so that its result does not depend on how far planning happens to be.
class Recorder {
 public:
  struct Options {
    std::filesystem::path directory;  ///< of the results, which exists; empty: no file is written
    results::TraceFiles trace = results::TraceFiles::kCsv;  ///< as which files the trace is written
    results::TraceOriginTexts origin{};                     ///< what an HDF5 trace says of its run
    std::vector<TraceSink*> sinks;                          ///< get the rows besides the files
    results::ColumnChoice columns;  ///< of the trace; empty: those of its layout
    Limits limits;
    double period = 0.001;                        ///< [s]
    bool has_machine = true;                      ///< else only set points are recorded
    bool is_wall_clock = false;                   ///< samples have the wall clock's figures
    Durability durability = Durability::kSynced;  ///< of the trace
  };

  /// @param blocks  of the program
  static Expected<Recorder> create(const Options& options, BlockSource blocks);

  /// Records the next sample.
  Expected<void> record(const results::Sample& sample);
  /// Hands the rows of the samples so far to the sinks.
  Expected<void> flush();

  /// Puts the figures of the samples so far into a summary.
  void summarise(results::Summary& summary);

  /// Hands the summary to the files that hold it beside the rows.
  void describe(const results::Summary& summary);
  /// Gives the files their names, or leaves them named as partial.
  Expected<void> commit();
  void abandon() noexcept;

  std::int64_t samples() const noexcept { return samples_; }
  /// Largest programmed feedrate of the blocks so far [mm/s].
  double largest_feedrate() const noexcept { return largest_feedrate_; }
  /// Way of the set points so far [mm].
  double path_length() const noexcept { return path_length_; }
  const results::Sample& last() const noexcept { return last_; }

 private:
  Recorder(const Options& options, BlockSource blocks);

  using PeakPlaces = results::OfEachPeak<std::optional<results::Place>>;

  Expected<void> begin();
  Expected<void> commit_timing() const;

  Expected<void> read_ahead(std::int64_t block);
  /// What the recorder must know of a block.
  struct BlockFacts {
    bool is_rapid = false;
    double program_zero = 0.0;  // [mm]
  };

  BlockFacts facts_of(std::int64_t block);
  double signed_error(double size, const Vec2& from_path) const noexcept;
  results::SampleErrors errors_of(const results::Sample& sample, results::Deviations& deviations);
  void audit(const results::Sample& sample);
  void note_peaks();
  std::optional<results::CuttingStats> cutting() const;

  Options options_;
  BlockSource blocks_;
  bool program_ended_ = false;
  results::ColumnChoice columns_;
  std::deque<BlockFacts> facts_;  // of blocks, from first_fact_ on
  std::int64_t first_fact_ = 0;   // number of the block facts_.front()
  results::ProgramZero program_zero_;
  std::unique_ptr<results::CsvTrace> csv_;
  std::unique_ptr<results::Hdf5Trace> hdf5_;
  TraceSinks sinks_;
  std::vector<double> rows_;  // not handed to the sinks yet (rows x columns)
  std::optional<results::LimitWriter> limit_;
  results::ContourTracker in_space_;
  results::ContourTracker along_z_;
  results::FeedrateFluctuation fluctuation_;
  results::LimitAudit audit_;
  std::array<results::Place, 64> recent_{};  // of the set points, by their number modulo 64
  results::OfEachPeak<std::int64_t> noted_;  // peaks whose places are in peaks_at_
  PeakPlaces peaks_at_;
  results::MotionFigures all_;
  results::MotionFigures no_rapids_;  // without rapids
  results::MotionFigures pen_down_;   // without rapids and with the pen down
  Vec2 direction_ = Vec2::UnitX();    // of the motion of the set point, seen along Z
  double largest_feedrate_ = 0.0;     // programmed [mm/s]
  double path_length_ = 0.0;          // way of the set points [mm]
  results::LogHistogram cycle_time_;
  CycleTiming timing_;
  std::int64_t samples_ = 0;
  results::Sample last_{};
};

}  // namespace twin::runtime
