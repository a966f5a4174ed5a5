#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/limits.hpp"
#include "core/setting.hpp"
#include "results/metrics/limit_audit.hpp"

namespace twin::results {

/// Largest value and root mean square of an error.
struct ErrorStats {
  double max = 0.0;  ///< [mm]
  double rms = 0.0;  ///< [mm]
};

/// Largest value and root mean square of shares [-]; 0.01 is 1 %.
struct ShareStats {
  double max = 0.0;
  double rms = 0.0;
};

/// Wall-clock time that the computation of one cycle took.
struct CycleTimes {
  double p50 = 0.0;  ///< [s]
  double p99 = 0.0;  ///< [s]
  double max = 0.0;  ///< [s]
};

/// Distribution of a time.
struct TimeStats {
  double p50 = 0.0;   ///< [s]
  double p99 = 0.0;   ///< [s]
  double p999 = 0.0;  ///< [s]
  double max = 0.0;   ///< [s]
};

/// How a run kept to the wall clock.
struct RealTimeStats {
  TimeStats wake_up;               ///< from a period's deadline to its begin
  TimeStats compute;               ///< of interpolator, servo and monitors
  TimeStats total;                 ///< from the deadline to the written outputs
  std::int64_t late_periods = 0;   ///< periods that began at the next deadline or later
  double worst_latency = 0.0;      ///< of all periods, those at rest included [s]
  std::vector<std::string> notes;  ///< what the system did not grant
};

/// The NC blocks of a program. The lengths are those of the short blocks.
struct BlockStats {
  std::int64_t total = 0;
  std::int64_t short_blocks = 0;  ///< blocks in runs of continuous short blocks
  double length_min = 0.0;        ///< [mm]
  double length_mean = 0.0;       ///< [mm]
  double length_max = 0.0;        ///< [mm]
};

/// The segments that the blocks became.
struct SegmentCounts {
  std::int64_t total = 0;
  std::int64_t curves = 0;
  std::int64_t lines = 0;
  std::int64_t arcs = 0;
};

/// What the certified planner guarantees of its path.
struct Certificate {
  double deviation = 0.0;  ///< bound of the distance between path and program, both ways [mm]
  std::int64_t spans = 0;  ///< of the fitted curves
};

/// A change of the feed override. Times count from the first set point.
struct OverrideRecord {
  double asked_at = 0.0;  ///< [s]
  double percent = 0.0;   ///< of the programmed feedrate; 0 is a feed hold [%]
  double from = 0.0;      ///< when the motion begins to follow it; a hold begins to brake [s]
};

/// What only a run on a machine has.
struct MachineResults {
  double machining_time = 0.0;               ///< first set point to last sample [s]
  ErrorStats contour_error;                  ///< encoder against programmed path
  ErrorStats table_contour_error;            ///< true position against programmed path
  std::array<ErrorStats, 2> tracking_error;  ///< x, y: set point less encoder
  CycleTimes cycle_time;
  double real_time_factor = 0.0;          ///< machining time over wall-clock time [-]
  std::optional<RealTimeStats> realtime;  ///< of a run on the wall clock; else there is none
};

/// All results of a run, as summary.json holds them, and what the run was made from.
struct Summary {
  std::string program;       ///< file name of the program
  std::string machine;       ///< name of the machine file
  std::string hal;           ///< "mujoco", "ideal", "rig"; "none" for a plan
  std::string planner;       ///< that planned: "certified", "paper"
  std::string interpolator;  ///< "nurbs", "bezier", "linear"
  bool simulated = true;     ///< false only where metal moved
  double period = 0.001;     ///< [s]
  BlockStats blocks;
  SegmentCounts segments;
  std::optional<Certificate> certified;  ///< of the certified planner's path
  double compression_factor = 0.0;       ///< short blocks over the curves they became [-]
  double path_length = 0.0;              ///< [mm]
  double planned_time = 0.0;             ///< before running, without override [s]
  std::optional<double> time_bound;      ///< lower bound of planned_time, where asked for [s]
  std::optional<double> planning_time;   ///< wall-clock time of planning, where measured [s]
  std::vector<OverrideRecord> overrides;
  ErrorStats command_contour_error;  ///< set points against programmed path
  ShareStats feedrate_fluctuation;   ///< see FeedrateFluctuation
  AuditPeaks audit;
  std::optional<MachineResults> run;  ///< there is none for a plan

  std::vector<std::string> notes;  ///< what was changed of what was asked for, and why
  std::string version;             ///< of the program that made the run, as in "0.9.0"
  std::string command;             ///< the command line, or a caller's own words; may be empty
  std::string program_sha256;      ///< of the program's bytes, 64 hexadecimal digits
  std::vector<Setting> settings;   ///< the whole machine file, as it was in force
};

/// Text of summary.json: keys in a fixed order, nine significant digits, the same bytes for the
/// same results.
///
/// The numbers are those of quantities(). A number that is not finite is written as null, and what
/// a run does not have is left out. Settings keep all the digits of the machine file.
std::string to_json(const Summary& summary);

/// The table for the terminal: quantities with units, peaks beside their limits.
std::string to_table(const Summary& summary, const Limits& limits);

}  // namespace twin::results
