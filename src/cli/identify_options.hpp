#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/options.hpp"

namespace twin::cli {

/// Options of `twin identify` alone.
struct IdentifyOptions {
  std::vector<std::string> traces;  ///< CSV files
  std::string columns;              ///< SIGNAL=COLUMN[:UNIT],...
  std::vector<std::string> fixed;   ///< keys that keep the machine file's value
  std::vector<std::string> freed;   ///< keys that are fitted though they would be held
  std::uint32_t seed = 1;
  std::size_t evaluations = 1200;  ///< simulations of the global search, an axis
};

/// Adds `identify` with its options.
CLI::App* add_identify_command(CLI::App& app, Options& options, IdentifyOptions& identify);

}  // namespace twin::cli
