#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "results/trace/hdf5.hpp"
#include "twin/trace.hpp"

namespace twin::results {

/// What an HDF5 trace says of its run, as attributes of the file.
struct TraceOriginTexts {
  std::string program;         ///< name of the NC program
  std::string program_sha256;  ///< checksum of its bytes
  std::string settings;        ///< the machine file as used, TOML
};

/// Streams a trace into DIR/trace.h5, with what is known of the run as attributes.
///
/// Until commit() the rows are in DIR/trace.partial.h5; there they stay when the run fails, is
/// interrupted, or the process is killed. In the last case up to kHdf5ChunkRows rows are missing at
/// the end, and so is the attribute `summary`. A commit replaces an older trace in one step.
class Hdf5Trace final : public TraceSink {
 public:
  /// @param directory  folder of the results, which exists when the run begins
  Hdf5Trace(std::filesystem::path directory, TraceOriginTexts origin,
            Durability durability = Durability::kSynced)
      : directory_(std::move(directory)), origin_(std::move(origin)), durability_(durability) {}

  std::optional<Error> begin(const TraceHeader& header) override;
  std::optional<Error> rows(std::span<const double> values) override;
  std::optional<Error> commit() override;
  void abandon() noexcept override;

  /// Sets the attribute `summary` that commit() or abandon() writes.
  void set_summary(std::string json) { summary_ = std::move(json); }

 private:
  Expected<void> open(const TraceHeader& header);
  Expected<void> finish();

  std::filesystem::path directory_;
  TraceOriginTexts origin_;
  Durability durability_;
  std::string summary_;
  std::optional<AtomicFile> file_;  // its name, lock and place; the writer fills it
  std::unique_ptr<Hdf5Writer> writer_;
};

}  // namespace twin::results
