#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "studies/reproduce/published.hpp"

namespace twin::studies::reproduce {

/// How to fit a machine to the published tables.
struct TableFitOptions {
  std::size_t evaluations = 1700;  ///< of the cost; each runs every row two or three times
  std::uint32_t seed = 1;
  const std::atomic<bool>* stop = nullptr;       ///< set to end early with the best so far
  std::function<void(double, double)> progress;  ///< gets the done share and the least cost
};

/// One parameter after the fit, in its key's unit.
struct FittedValue {
  std::string key;
  double before = 0.0;
  double after = 0.0;
  double rise = 0.0;  ///< of the cost when the parameter is moved by a tenth of its range, the
                      ///< lesser of both ways
  bool is_at_bound = false;  ///< of the range that was searched
};

/// What a fit to the tables found.
struct TableFit {
  config::MachineFile machine;
  double cost_before = 0.0;
  double cost_after = 0.0;
  double time_error = 0.0;  ///< RMS of machining time / published - 1 [-]
  std::vector<FittedValue> values;
  bool was_stopped = false;
};

/// Cost of a number that should be `published`: with e = ln(ours / published)
///   e^2 / (2 (e^2 + 0.15^2)) + e^2 / (2 (e^2 + 0.28^2)) + e^2 / 20,
/// so that a number that cannot be reached costs about 1 and does not pull the others along.
double smooth_cost(double ours, double published);

/// Cost of a number by the shares in which numbers are counted: with d = |ours / published - 1| and
/// S the logistic function
///   S((d - 0.19) / 0.02) + 0.8 S((d - 0.285) / 0.02) + smooth_cost / 4.
double share_cost(double ours, double published);

/// One set of parameters of the table and of the servo for all measured rows of the published
/// tables.
///
/// First the planning model: Kp / (1 - Kf) stays as it is (Eq. 1 with Table 2 gives it), and Kf is
/// chosen so that the machining times fit best. Then the table: the rows, each with its own
/// variants of the method, are run on studies::identify::TableRun, and CMA-ES looks for the least sum over
/// the errors of all rows, in two stages:
///   smooth_cost of the mean of two runs, from the start far and wide;
///   share_cost of the mean of three runs, and 0.4 of that of the first one, near what was found.
/// The runs of a row have the phases of with_phases_of_repeat, the first one those of the machine.
///
/// Masses and lead are held: the tables do not identify them, nor much else (FittedValue::rise).
Expected<TableFit> fit_tables(const Published& published, const config::MachineFile& start,
                              const TableFitOptions& options);

/// What a fit to the published tables found, as a table for the terminal.
std::string to_table(const TableFit& fit);

}  // namespace twin::studies::reproduce
