#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "studies/search/minimise.hpp"

namespace twin::studies::identify {

/// A search as a file keeps it, so that a killed one can go on.
struct Checkpoint {
  std::string fit;  ///< what is fitted, in a text that any other fit has not
  int stage = 0;    ///< of the searches that follow one another
  search::SearchState state;
};

/// Writes a checkpoint whole or not at all.
Expected<void> write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Reads a checkpoint.
///
/// @param fit  what is fitted now
/// @returns nothing where there is no file; a kFile error for one that is no checkpoint, or one of
///          another fit
Expected<std::optional<Checkpoint>> read_checkpoint(const std::filesystem::path& file,
                                                    const std::string& fit);

}  // namespace twin::studies::identify
