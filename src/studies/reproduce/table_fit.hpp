#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "studies/reproduce/published.hpp"

namespace twin::studies::reproduce {

/// Options of a fit to the published tables.
struct TableFitOptions {
  std::size_t evaluations = 1700;  ///< how often the cost is computed, with 1 or 3 runs of each row
  std::uint32_t seed = 1;
  const std::atomic<bool>* stop = nullptr;       ///< set to end early with the best so far
  std::filesystem::path checkpoint;              ///< file to go on from and to keep; empty: none
  std::function<void(double, double)> progress;  ///< gets the done share and the least cost
};

/// One parameter after the fit, in its key's unit.
struct FittedValue {
  std::string key;
  double before = 0.0;
  double after = 0.0;
  double rise = 0.0;  ///< rise of the cost if the parameter is moved by a tenth of its range, the
                      ///< smaller one of both directions
  bool is_at_bound = false;  ///< whether the value is at an end of the range that was searched
};

/// Result of a fit to the published tables.
struct TableFit {
  config::MachineFile machine;
  double cost_before = 0.0;
  double cost_after = 0.0;
  double time_error = 0.0;  ///< RMS over all rows of machining time / published one - 1 [-]
  std::vector<FittedValue> values;
  bool was_stopped = false;
  bool was_resumed = false;  ///< went on from the checkpoint of a search that was cut off
};

/// Cost of the difference between our number and the published one. With e = ln(ours / published)
/// it is
///   e^2 / (2 (e^2 + 0.15^2)) + e^2 / (2 (e^2 + 0.28^2)) + e^2 / 20.
/// The first two terms saturate, so a number that cannot be reached costs about 1 and hardly
/// affects the fit of the others.
double smooth_cost(double ours, double published);

/// Cost that follows how the comparison counts numbers: those within 20 % and within 30 % of the
/// published ones. With d = |ours / published - 1| and the logistic function S it is
///   S((d - 0.19) / 0.02) + 0.8 S((d - 0.285) / 0.02) + smooth_cost / 4.
double share_cost(double ours, double published);

/// Finds one set of parameters of table and servo for all measured rows of the published tables.
///
/// First the planning model is fitted. Kp / (1 - Kf) stays as it is, since Eq. 1 with Table 2 gives
/// it, and Kf is chosen so that the machining times fit best. Then the table is fitted: each row is
/// run with the method that it was measured with, on studies::identify::TableRun, and CMA-ES
/// searches for the smallest sum of the costs of all rows, in two stages:
///   1. smooth_cost of one run with a coarse physics step, in a wide range around the start;
///   2. share_cost of the mean of three runs, plus 0.4 times that of the first run, near the
///      result of the first stage.
/// The runs of a row differ by the phases of with_phases_of_repeat(); the first run has the phases
/// of the machine file.
///
/// Masses and screw lead are not fitted, because the tables do not determine them.
/// FittedValue::rise shows how little they determine other parameters.
Expected<TableFit> fit_tables(const Published& published, const config::MachineFile& start,
                              const TableFitOptions& options);

/// What a fit to the published tables found, as a table for the terminal.
std::string to_table(const TableFit& fit);

}  // namespace twin::studies::reproduce
