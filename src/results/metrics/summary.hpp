#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/limits.hpp"
#include "results/metrics/limit_audit.hpp"
#include "results/metrics/override_record.hpp"

namespace twin::results {

/// Largest value and root mean square of an error.
struct ErrorFigures {
  double max = 0.0;  ///< [mm]
  double rms = 0.0;  ///< [mm]
};

/// Largest value and root mean square of shares [-]; 0.01 is 1 %.
struct ShareFigures {
  double max = 0.0;
  double rms = 0.0;
};

/// Wall-clock time of one cycle's computation.
struct CycleTimes {
  double p50 = 0.0;  ///< [s]
  double p99 = 0.0;  ///< [s]
  double max = 0.0;  ///< [s]
};

/// Distribution of a time.
struct TimeFigures {
  double p50 = 0.0;   ///< [s]
  double p99 = 0.0;   ///< [s]
  double p999 = 0.0;  ///< [s]
  double max = 0.0;   ///< [s]
};

/// How a run kept to the wall clock.
struct RealTimeFigures {
  TimeFigures wake_up;             ///< begin of a period after its deadline
  TimeFigures compute;             ///< interpolator, servo and monitors
  TimeFigures total;               ///< from the deadline to the written outputs
  std::int64_t late_periods = 0;   ///< begun at the next deadline or later
  double worst_latency = 0.0;      ///< of all periods, those at rest included [s]
  std::vector<std::string> notes;  ///< what the system did not grant
};

/// The NC blocks of a program.
struct BlockFigures {
  std::int64_t total = 0;
  std::int64_t short_blocks = 0;  ///< those in continuous short blocks
  double length_min = 0.0;        ///< [mm]
  double length_mean = 0.0;       ///< [mm]
  double length_max = 0.0;        ///< [mm]
};

/// The segments they became.
struct SegmentFigures {
  std::int64_t total = 0;
  std::int64_t curves = 0;
  std::int64_t lines = 0;
  std::int64_t arcs = 0;
};

/// What a path with a guarantee has.
struct CertifiedFigures {
  double deviation = 0.0;  ///< bound of the path's distance from the program, both ways [mm]
  std::int64_t spans = 0;  ///< of the fitted curves
};

/// What only a run on a machine has.
struct MachineFigures {
  double machining_time = 0.0;                 ///< first set point to last sample [s]
  ErrorFigures contour_error;                  ///< encoder against programmed path
  ErrorFigures table_contour_error;            ///< true position against programmed path
  std::array<ErrorFigures, 2> tracking_error;  ///< x, y: set point less encoder
  CycleTimes cycle_time;
  double real_time_factor = 0.0;            ///< machining time over wall-clock time [-]
  std::optional<RealTimeFigures> realtime;  ///< on the wall clock only; else its key is left out
};

/// All results of a run, as summary.json holds them.
struct Summary {
  std::string program;       ///< file name of the program
  std::string machine;       ///< name of the machine file
  std::string hal;           ///< "mujoco", "ideal", "rig"; "none" for a plan
  std::string interpolator;  ///< "nurbs", "bezier", "linear"
  bool simulated = true;     ///< false only where metal moved
  double period = 0.001;     ///< [s]
  BlockFigures blocks;
  SegmentFigures segments;
  std::optional<CertifiedFigures> certified;  ///< else its keys are left out
  double compression_factor = 0.0;            ///< blocks over segments [-]
  double path_length = 0.0;                   ///< [mm]
  double planned_time = 0.0;                  ///< before running, without override [s]
  std::optional<double> time_bound;           ///< lower bound of it, where asked for [s]
  std::vector<OverrideRecord> overrides;      ///< empty: its key is left out
  ErrorFigures command_contour_error;         ///< set points against programmed path
  ShareFigures feedrate_fluctuation;          ///< see FeedrateFluctuation
  AuditPeaks audit;
  std::optional<MachineFigures> run;  ///< absent for a plan; its keys are then left out
};

/// Text of summary.json: keys in a fixed order, 9 significant digits, the same bytes for the same
/// figures.
///
/// A figure that is not finite is written as null.
std::string to_json(const Summary& summary);

/// The short table for the terminal: figures with units, peaks beside their limits.
std::string to_table(const Summary& summary, const Limits& limits);

}  // namespace twin::results
