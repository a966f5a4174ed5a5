#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/limits.hpp"
#include "core/setting.hpp"
#include "results/metrics/limit_audit.hpp"
#include "results/metrics/place.hpp"
#include "results/trace/program_zero.hpp"

namespace twin::results {

/// Largest value and root mean square of an error.
struct ErrorStats {
  double max = 0.0;           ///< [mm]
  double rms = 0.0;           ///< [mm]
  std::optional<Place> at{};  ///< where the largest one was
};

/// Largest value and root mean square of a relative error [-]; 0.01 is 1 %.
struct ShareStats {
  double max = 0.0;
  double rms = 0.0;
};

/// Distribution of the wall-clock time that the computation of one cycle took.
struct CycleTimes {
  double p50 = 0.0;  ///< [s]
  double p99 = 0.0;  ///< [s]
  double max = 0.0;  ///< [s]
};

/// Distribution of a time: percentiles 50, 99 and 99.9, and the largest value.
struct TimeStats {
  double p50 = 0.0;   ///< [s]
  double p99 = 0.0;   ///< [s]
  double p999 = 0.0;  ///< [s]
  double max = 0.0;   ///< [s]
};

/// How punctual a run on the wall clock was. A period has a deadline at which it should begin.
struct RealTimeStats {
  TimeStats wake_up;               ///< from the deadline of a period to its begin
  TimeStats compute;               ///< computing time of interpolator, servo and monitors
  TimeStats total;                 ///< from the deadline to the end of writing the outputs
  std::int64_t late_periods = 0;   ///< periods that began at the next deadline or later
  double worst_latency = 0.0;      ///< latest begin of any period, also of those at rest [s]
  std::vector<std::string> notes;  ///< real-time features that the system refused
};

/// Counts of the NC blocks of a program, and the lengths of its short blocks.
struct BlockStats {
  std::int64_t total = 0;
  std::int64_t short_blocks = 0;  ///< blocks in runs of continuous short blocks
  double length_min = 0.0;        ///< [mm]
  double length_mean = 0.0;       ///< [mm]
  double length_max = 0.0;        ///< [mm]
};

/// Counts of the segments that path building made of the blocks.
struct SegmentCounts {
  std::int64_t total = 0;
  std::int64_t curves = 0;
  std::int64_t lines = 0;
  std::int64_t arcs = 0;
};

/// What the certified planner guarantees of its path.
struct Certificate {
  double deviation = 0.0;  ///< no point of path or program is farther from the other [mm]
  std::int64_t spans = 0;  ///< number of spans of the fitted curves
};

/// A change of the feed override. Times count from the first set point.
struct OverrideRecord {
  double asked_at = 0.0;  ///< time of the request [s]
  double percent = 0.0;   ///< share of the programmed feedrate; 0 is a feed hold [%]
  double from = 0.0;      ///< time at which it takes effect; for a hold the begin of braking [s]
};

/// Errors of the machine in the cutting motion, as those of the whole run in MachineResults.
struct CuttingErrors {
  ErrorStats contour_error;
  ErrorStats table_contour_error;
  std::array<ErrorStats, 2> tracking_error;  ///< x, y
};

/// Figures of the cutting motion alone: without rapids, and without motion with the pen up where the
/// program ever lowers it.
struct CuttingStats {
  double time = 0.0;  ///< [s]
  ErrorStats command_contour_error;
  std::optional<CuttingErrors> run;  ///< nothing for a plan
};

/// How a run ended that did not come to the end of its program.
struct EarlyEnd {
  std::string reason;       ///< the message of its error
  std::optional<Place> at;  ///< the last set point; nothing if there was none
};

/// Position loop of an axis by the model of the machine file, without friction.
struct LoopFigures {
  double bandwidth_Hz = 0.0;      ///< where the closed loop falls to -3 dB
  double phase_margin_deg = 0.0;  ///< [deg]
  double gain_margin = 0.0;       ///< factor of the gain at which the loop oscillates [-]
};

/// Results that only a run on a machine has.
struct MachineResults {
  double machining_time = 0.0;               ///< from the first set point to the last sample [s]
  ErrorStats contour_error;                  ///< encoder position against programmed path
  ErrorStats table_contour_error;            ///< true position against programmed path
  std::array<ErrorStats, 2> tracking_error;  ///< x, y: set point less encoder
  CycleTimes cycle_time;
  double real_time_factor = 0.0;          ///< machining time over wall-clock time [-]
  std::optional<RealTimeStats> realtime;  ///< nothing if the run was not on the wall clock
};

/// All results of a run, as summary.json holds them, and what the run was made from.
struct Summary {
  std::string program;       ///< file name of the program
  std::string machine;       ///< name of the machine file
  std::string hal;           ///< machine: "mujoco", "ideal", "rig"; "none" for a plan
  std::string planner;       ///< planning.planner: "certified", "paper"
  std::string interpolator;  ///< path.curves: "nurbs", "bezier", "linear"
  bool simulated = true;     ///< false if real axes moved
  double period = 0.001;     ///< [s]
  BlockStats blocks;
  SegmentCounts segments;
  std::optional<Certificate> certified;  ///< nothing for the planner "paper"
  double compression_factor = 0.0;       ///< number of short blocks per fitted curve [-]
  double path_length = 0.0;              ///< [mm]
  double planned_time = 0.0;             ///< time of motion without override, by the plan [s]
  std::int64_t plan_fallbacks = 0;       ///< times that no plan within all limits was found [-]
  std::optional<double> time_bound;      ///< lower bound of planned_time, if asked for [s]
  std::optional<double> planning_time;   ///< wall-clock time of planning, if measured [s]
  std::vector<OverrideRecord> overrides;
  ErrorStats command_contour_error;  ///< set points against programmed path
  ShareStats feedrate_fluctuation;   ///< see FeedrateFluctuation
  AuditPeaks audit;
  OfEachPeak<std::optional<Place>> audit_at;  ///< where the peaks were
  std::optional<CuttingStats> cutting;        ///< nothing without any cutting motion
  /// Where the run ended early. The figures are then of what was done: path_length is the length of
  /// the way to there, and counts and times of the plan are not shown.
  std::optional<EarlyEnd> early_end;
  std::optional<MachineResults> run;  ///< nothing for a plan
  /// Position loops of x and y; nothing where the machine file's servo closes none.
  std::optional<std::array<LoopFigures, 2>> loops;

  std::vector<std::string> notes;  ///< settings that were changed for the run, and why
  std::string version;             ///< version of twin that made the run, as in "0.9.0"
  std::string command;             ///< the command line, or a caller's own words; may be empty
  std::string program_sha256;      ///< checksum of the NC program, 64 hexadecimal digits
  /// Files of subprograms that the program called, each with its checksum.
  std::vector<std::pair<std::string, std::string>> subprograms;
  ProgramZero program_zero;       ///< over the time of the run
  std::vector<Setting> settings;  ///< all settings of the machine file, as used
};

/// Text of summary.json: keys in a fixed order, nine significant digits, the same bytes for the
/// same results.
///
/// The numbers are those of quantities(). A number that is not finite is written as null, and what
/// a run does not have is left out. Settings keep all the digits of the machine file.
std::string to_json(const Summary& summary);

/// The same without what differs from one computation of the same run to the next: computing times
/// and the command line.
std::string to_reproducible_json(const Summary& summary);
/// The text of a summary.json without them.
std::string reproducible(const std::string& summary_json);

/// The table for the terminal: quantities with units, peaks beside their limits.
std::string to_table(const Summary& summary, const Limits& limits);

}  // namespace twin::results
