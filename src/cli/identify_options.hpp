#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
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
  std::optional<std::size_t> evaluations;  ///< simulations of the global search
  bool tables = false;                     ///< the published tables take the place of traces
};

/// Adds the options of `identify`.
void add_identify_options(CLI::App& command, Options& options, IdentifyOptions& identify);

}  // namespace twin::cli
