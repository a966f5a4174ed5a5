#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "studies/batch/store.hpp"
#include "studies/batch/sweep.hpp"

namespace twin::studies::batch {

/// One job of a sweep with its result.
struct Row {
  SweepPoint point;
  PreparedJob job;
  StoredResult result;
};

/// What a sweep is looked at by: machining time and the largest contour error at the encoders. Not
/// numbers where the run failed or has no such figure.
struct Merit {
  double time = 0.0;           ///< [s]
  double contour_error = 0.0;  ///< [um]
};
Merit merit_of(const StoredResult& result);

/// A result with those figures of its summary alone that the table and the merit need.
StoredResult figures_of(const StoredResult& result);

/// One combination of settings, over all programs of a sweep.
struct Candidate {
  std::vector<std::string> values;  ///< of the keys but "program"
  Merit merit;                      ///< time of all programs together, largest error of any
  std::string failure;              ///< of the first run that failed; empty if none did
  std::size_t row = 0;              ///< one of its rows
};

/// The combinations of settings, in the order in which they come.
std::vector<Candidate> candidates_of(const std::vector<std::string>& keys,
                                     const std::vector<Row>& rows);

/// The candidates that no other is better than in both time and contour error, by ascending time.
std::vector<std::size_t> pareto_front(const std::vector<Candidate>& candidates);

/// The results as CSV: the keys of the sweep, main figures, failure, key of the job; a line a job.
std::string to_csv(const std::vector<std::string>& keys, const std::vector<Row>& rows);

/// The same table as an HDF5 file: a dataset a column, with its unit; numbers where all values of a
/// setting are some, texts otherwise. Written whole or not at all.
Expected<void> write_hdf5(const std::vector<std::string>& keys, const std::vector<Row>& rows,
                          const std::filesystem::path& file);

}  // namespace twin::studies::batch
