#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "twin/export.hpp"

namespace twin {

/// What is tuned, for what, within what, and where the results go.
struct TuneOptions {
  std::vector<std::string> programs{};    ///< files, or names of programs that twin brings
  std::string machine = "xy_table.toml";  ///< machine file, or the name of one that twin brings
  std::vector<std::string> settings{};    ///< SECTION.KEY=VALUE, of every run
  std::optional<double> feedrate{};       ///< replaces the programs' F words [mm/s]
  /// True: least machining time within `largest_error`. False: least contour error.
  bool is_for_time = false;
  double largest_error = 0.0;         ///< contour error to keep, of least machining time [um]
  double gain_margin_dB = 6.0;        ///< least of both position loops [dB]
  double phase_margin_deg = 30.0;     ///< least of both position loops [deg]
  std::vector<std::string> ranges{};  ///< KEY=FROM:TO or KEY=FROM:TO:log; empty: the usual ones
  std::vector<std::string> further_programs{};  ///< judged at the end, not tuned on
  std::size_t trials = 2000;                    ///< combinations of settings at most
  std::uint32_t seed = 1;                       ///< same seed, same result, on any number of cores
  unsigned workers = 0;                         ///< at a time; 0: as many as there are cores
  std::string store{};                      ///< of the runs; what it holds is not computed again
  std::string folder{};                     ///< gets best.toml, tune.json, results.csv, index.html
  const std::atomic<bool>* stop = nullptr;  ///< ends it when another thread sets it; may be null
};

/// What a search has found.
struct Tuned {
  std::string table;         ///< what `twin tune` prints
  std::string json;          ///< the text of tune.json
  std::string machine_file;  ///< best.toml
};

/// Searches for the servo gains and planner settings that are best for some programs, by CMA-ES over
/// whole runs.
///
/// @throws Failure if the options are wrong, no settings have the margins, or kInterrupted
TWIN_EXPORT Tuned tune(const TuneOptions& options);

}  // namespace twin
