#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "studies/batch/store.hpp"

namespace twin::studies::batch {

/// How far a batch is.
struct Progress {
  std::size_t jobs = 0;    ///< all of them
  std::size_t done = 0;    ///< stored, by this batch or before it
  double time_left = 0.0;  ///< by the pace so far [s]
};

/// How a batch is run.
struct Options {
  unsigned workers = 0;                     ///< runs at a time; 0: as many as there are cores
  std::size_t shard = 0;                    ///< only jobs whose number is this,
  std::size_t shards = 1;                   ///< divided by this with remainder
  const std::atomic<bool>* stop = nullptr;  ///< ends it; jobs under way are given up
  std::function<void(const Progress&)> progress{};  ///< one call at a time
  /// Gets each job that is done or was in the store, and its result; one call at a time.
  std::function<void(const PreparedJob&, const StoredResult&)> result{};
};

/// What a batch has done.
struct Report {
  std::size_t jobs = 0;      ///< of this shard
  std::size_t computed = 0;  ///< by this batch
  std::size_t found = 0;     ///< in the store before
  std::size_t redone = 0;    ///< of those computed, whose result in the store was broken
  std::size_t failed = 0;    ///< of both, whose run failed; kept with the reason
  double time = 0.0;         ///< wall-clock time [s]
};

/// Runs the jobs that a store does not hold, in lockstep, over the cores. Equal jobs are run once.
///
/// A run that fails is a result like another and is kept. What fails for want of the computer's disk,
/// memory, descriptors or threads is no result: the other jobs are run, then the first such error is
/// returned, and such a job runs again at the next call. An error of the store ends the batch; what
/// is stored stays.
Expected<Report> run_batch(std::span<const PreparedJob> jobs, const Store& store,
                           const Options& options);

/// Runs one job.
///
/// @param folder  gets trace.csv if the job keeps it
/// @param stop    ends it; may be null
/// @returns what the store keeps; kInterrupted if it was stopped; kFile or kHost if the computer
///          failed and not the run
Expected<StoredResult> run_job(const PreparedJob& job, const std::filesystem::path& folder,
                               const std::atomic<bool>* stop);

}  // namespace twin::studies::batch
