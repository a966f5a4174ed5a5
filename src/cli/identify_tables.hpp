#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>

#include "config/machine_file.hpp"
#include "core/error.hpp"

namespace twin::cli {

/// twin identify --tables.
struct IdentifyTables {
  config::MachineFile start;
  std::filesystem::path out;  ///< machine file to write
  std::size_t evaluations = 1700;
  std::uint32_t seed = 1;
  bool quiet = false;
};

/// Fits the published tables, prints what was found and writes the machine file. Interrupted, it
/// writes the best so far.
Expected<void> identify_tables(const IdentifyTables& request, const std::atomic<bool>& stop);

}  // namespace twin::cli
