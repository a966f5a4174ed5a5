#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

#include "twin/export.hpp"

namespace twin {

/// The jobs of a sweep file (TOML), a JSON line each, as `twin sweep --list` writes them.
/// @throws Failure with file, line and column, or if the sweep has too many jobs
TWIN_EXPORT std::vector<std::string> sweep_jobs(const std::string& sweep_file);

/// The key of a job, a JSON line as `twin batch` reads them: 64 hexadecimal digits that follow from
/// all that its result depends on.
/// @throws Failure if the job is none
TWIN_EXPORT std::string job_key(const std::string& job);

/// What a store has of a job.
struct JobResult {
  std::string key;
  bool was_found = false;  ///< it was in the store before
  std::string summary;     ///< text of summary.json; empty if the run failed
  std::string failure;     ///< why it failed; empty if it reached its end
};

/// Takes a job's result from a store, or runs it and stores its result. Several threads, processes
/// and hosts may do this with one store at once.
///
/// @param job    JSON line
/// @param store  folder; made if it is missing
/// @param stop   ends the run when another thread sets it; may be null
/// @throws Failure if the job is none or the store cannot be used, or kInterrupted
TWIN_EXPORT JobResult run_job(const std::string& job, const std::string& store,
                              const std::atomic<bool>* stop = nullptr);

/// Writes table, page and best machine file of a sweep whose results are all in a store, as
/// `twin sweep` does.
///
/// @param folder  of the results; made if it is missing
/// @throws Failure if a result is missing in the store
TWIN_EXPORT void write_sweep(const std::string& sweep_file, const std::string& store,
                             const std::string& folder);

}  // namespace twin
