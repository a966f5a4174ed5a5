#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "studies/batch/job.hpp"

namespace twin::studies::batch {

/// What a store holds of a job.
struct StoredResult {
  /// Text of summary.json without what computing took, which differs from time to time. Empty if
  /// the run failed.
  std::string summary;
  std::string failure;  ///< why the run failed; empty if it reached its end
};

/// Results of jobs, each in a folder of its own under the job's key.
///
///     STORE/twin-store.json          that it is a store, and of which layout
///     STORE/ab/abcd.../job.json      the canonical job, and the checksums of the files beside it
///     STORE/ab/abcd.../summary.json  or failure.json: {"error": "..."}
///     STORE/ab/abcd.../trace.csv, trace.h5     if the job keeps its trace
///     STORE/work/...                 what is being computed; what a killed process left there is
///                                    removed by the next one of its host
///
/// A result appears whole: its folder is made in work/ and renamed. Nothing waits for the disk: what
/// a loss of power leaves broken does not have its checksums, and is computed again. Equal jobs have equal bytes, so
/// whoever is second leaves what is there. Several processes, also on several hosts, may use a
/// store at once.
class Store {
 public:
  /// Opens a store, or makes one in a folder that is empty or missing.
  /// @returns an error if the folder holds something else, or a store of another layout
  static Expected<Store> open(std::filesystem::path folder);

  const std::filesystem::path& folder() const noexcept { return folder_; }

  /// Whether something is there in the place of a job's result, broken or not.
  bool has_entry(const PreparedJob& job) const;

  /// The result of a job; nothing if there is none, or one that is removed: a broken one, whose
  /// files are not those that job.json has the checksums of, or one of other files of subprograms.
  std::optional<StoredResult> find(const PreparedJob& job) const;

  /// An empty folder for the files of a job that is being computed.
  Expected<std::filesystem::path> begin(const PreparedJob& job) const;

  /// Makes the files in a folder of begin() the result of a job.
  Expected<void> commit(const PreparedJob& job, const std::filesystem::path& work,
                        const StoredResult& result) const;

  /// Folder of a job's result, whether it exists or not.
  std::filesystem::path folder_of(const PreparedJob& job) const;

 private:
  explicit Store(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
};

}  // namespace twin::studies::batch
