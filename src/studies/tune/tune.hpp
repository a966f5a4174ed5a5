#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "studies/tune/evaluator.hpp"

/// Servo gains, feedforwards and settings of the planner, found by a search over whole runs.
namespace twin::studies::tune {

/// How far a search is.
struct Progress {
  std::size_t trials = 0;  ///< of the whole search
  std::size_t done = 0;
  double cost = 0.0;  ///< least so far, see Evaluator
};

/// How to search.
struct Options {
  std::size_t trials = 2000;                    ///< at most
  std::uint32_t seed = 1;                       ///< same seed, same result, on any number of cores
  unsigned workers = 0;                         ///< trials at a time; 0: as many as there are cores
  std::vector<std::string> further_programs{};  ///< judged at the end, not tuned on
  const std::atomic<bool>* stop = nullptr;      ///< ends the search; what is stored stays
  std::function<void(const Progress&)> progress{};  ///< one call at a time
};

/// What one program shows before and after, on one table.
struct Judgement {
  std::string program;
  std::string table;  ///< "as it is", "20 % up", "20 % down"
  bool is_tuned_on = true;
  Trial before;
  Trial after;
};

/// What a search has found.
struct Tuning {
  std::vector<std::string> keys;
  Trial before;  ///< the machine file's own settings
  Trial best;
  std::vector<Trial> trials;  ///< all that were run, each combination once, in a fixed order
  std::vector<Judgement> judgements;
  config::MachineFile machine;  ///< with the best settings
  std::size_t asked = 0;        ///< combinations that the search has asked for
  std::size_t unstable = 0;     ///< of them, not run since their margins are too small
  std::size_t computed = 0;     ///< runs that were computed
  std::size_t found = 0;        ///< runs that were in the store
};

/// Searches by CMA-ES (search::CmaEs) for the settings of least cost, from those of the machine file
/// on. Then judges both on every program, also on tables that differ by 20 %.
///
/// All runs are jobs, whose results the store keeps: the same call after a kill finds what was done,
/// and goes on where it was.
///
/// @returns what was found; kInterrupted after a stop; an error of the task, or of the store; an error
///          where no combination with these margins reached the end of every program
Expected<Tuning> tune(const Task& task, const batch::Store& store, const Options& options);

}  // namespace twin::studies::tune
