#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/limits.hpp"
#include "results/metrics/summary.hpp"

namespace twin::results {

/// What a quantity is about; summary.json and the tables show the quantities of a group together.
enum class Group {
  kRun,        ///< the interpolation period
  kPath,       ///< blocks, segments, times
  kCutting,    ///< errors of the cutting motion alone
  kErrors,     ///< deviations from the programmed path and from the commanded feedrate
  kPeaks,      ///< of the motion along the path, beside their limits
  kAxisPeaks,  ///< of the motion of each axis
  kCycle,      ///< computing time of the cycle
  kWallClock,  ///< how a run kept to the wall clock
  kPlanning,   ///< how long planning took; not in summary.json
};

/// Whether a quantity counts something or measures it.
enum class QuantityKind { kCount, kMeasure };

/// One number of a run: what it is called, how it is written, and where a Summary has it.
struct Quantity {
  std::string_view key;      ///< with its unit, as in "contour_error_max_um"; for files of tables
  std::string_view pointer;  ///< its place in summary.json, as in "/contour_error_um/max"; or none
  std::string_view label;    ///< "contour error, encoder"
  std::string_view statistic;  ///< of several numbers with one label: "max", "rms", "median"
  std::string_view unit;       ///< as people write it, as in "um"; empty for a plain number
  int decimals;                ///< in a table
  Group group;
  QuantityKind kind;
  /// Its value in that unit, or nothing where the run has none.
  std::optional<double> (*get)(const Summary& summary);
  /// The limit that it should keep, in that unit; null where there is none.
  double (*limit)(const Limits& limits) = nullptr;
  /// Where a largest value was, or nothing where the run has none; null for other quantities.
  std::optional<Place> (*place)(const Summary& summary) = nullptr;

  /// "contour error, encoder, max"
  std::string name() const;
  /// A value of this quantity as a table shows it, without its unit; "-" for nothing.
  std::string text(const std::optional<double>& value) const;
};

/// All quantities of a run, in the order of summary.json.
///
/// This is the one list of them: summary.json, the tables on the terminal and the studies that
/// compare runs are views of it. A new quantity is a new line in quantities.cpp.
std::span<const Quantity> quantities();

/// The quantity of a key. There must be one.
const Quantity& quantity(std::string_view key);

}  // namespace twin::results
