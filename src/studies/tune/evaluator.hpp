#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/loop_margins.hpp"
#include "studies/batch/batch.hpp"
#include "studies/batch/results_table.hpp"
#include "studies/tune/varied_key.hpp"

namespace twin::studies::tune {

/// A factor in decibels.
double dB(double factor);

/// Least margins of stability of both position loops, by the machine file's model.
struct LeastMargins {
  double gain_dB = 6.0;
  double phase_deg = 30.0;
};

/// What is tuned, for what, and within what.
struct Task {
  std::vector<std::string> programs;      ///< files, or names in nc_programs; at least one
  std::string machine = "xy_table.toml";  ///< machine file, or name in mjcf
  std::vector<std::string> settings;      ///< KEY=VALUE, of every run
  std::optional<double> feedrate;         ///< replaces the programs' F words [mm/s]
  Aim aim = Aim::kContourError;
  double largest_error = 0.0;  ///< for kTime: the contour error to keep [um]
  LeastMargins margins;
  std::vector<VariedKey> keys;  ///< at least one
};

/// What a combination of settings has shown.
struct Trial {
  std::vector<std::string> values;  ///< of the keys
  double cost = std::numeric_limits<double>::infinity();
  std::array<config::LoopMargins, 2> loops{};  ///< x, y
  batch::Merit merit{std::numeric_limits<double>::quiet_NaN(),
                     std::numeric_limits<double>::quiet_NaN()};  ///< time together, largest error
  std::vector<batch::Row> rows;  ///< a run each program; empty where the margins are too small
};

/// Runs combinations of settings on all programs of a task, as jobs whose results a store keeps.
/// What the store holds is not run again. Several threads may use it at once.
///
/// The cost orders trials. For kContourError it is the largest contour error of any program [um]; for
/// kTime the time of all programs together [s] where the error is kept, and beyond that more than any
/// time, rising with the error. A trial with too small margins is not run, and costs more than any
/// that is; the more is missing, the more it costs.
class Evaluator {
 public:
  Evaluator(const Task& task, const batch::Store& store, const std::atomic<bool>* stop)
      : task_(task), store_(store), stop_(stop) {}

  /// Tries the settings at a point of the unit cube, if they leave the least margins.
  Expected<Trial> try_at(std::span<const double> point);
  /// Runs settings whatever their margins are.
  /// @param values    of the task's keys; empty: as the machine file has them
  /// @param further   KEY=VALUE that are changed besides
  Expected<Trial> run_values(const std::vector<std::string>& values,
                             const std::vector<std::string>& further,
                             const std::vector<std::string>& programs);

  std::size_t runs() const noexcept { return runs_; }    ///< that were computed
  std::size_t found() const noexcept { return found_; }  ///< that were in the store

 private:
  Expected<batch::PreparedJob> prepare(const std::string& program,
                                       const std::vector<std::string>& settings);
  std::vector<std::string> settings_of(const std::vector<std::string>& values) const;
  Expected<Trial> run(Trial trial, const std::vector<std::string>& settings,
                      const std::vector<std::string>& programs, bool is_margin_needed);
  Expected<batch::StoredResult> result_of(const batch::PreparedJob& job);
  double cost_of(const Trial& trial) const;
  double missing_margins(const Trial& trial) const;

  const Task& task_;
  const batch::Store& store_;
  const std::atomic<bool>* stop_;
  std::mutex maker_mutex_;
  batch::JobMaker maker_;
  std::atomic<std::size_t> runs_{0};
  std::atomic<std::size_t> found_{0};
};

}  // namespace twin::studies::tune
