#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/batch/results_table.hpp"

namespace twin::studies::batch {

/// Writes what a sweep has found into a folder: jobs.jsonl, results.csv, results.h5, index.html with the front
/// and parallel coordinates, and best.toml, the machine file with the least contour error
/// of the front. Where no combination of settings has reached every end there is no best.toml.
Expected<void> write_sweep(const std::vector<std::string>& keys, const std::vector<Row>& rows,
                           const std::string& title, const std::filesystem::path& folder);

}  // namespace twin::studies::batch
