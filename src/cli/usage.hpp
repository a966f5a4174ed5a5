#pragma once

#include <span>
#include <string>
#include <vector>

namespace twin::cli {

/// Names that may stand in a command line after a command.
struct CommandNames {
  std::string name;
  std::vector<std::string> options;    ///< "--help", "-h"
  std::vector<CommandNames> commands;  ///< below it
};

/// What is wrong with the names in a command line; empty where nothing is. It looks into the
/// commands below: `twin rig probe`.
///
/// @param names  of the program
/// @param words  the command line without the program's name
std::string explain(const CommandNames& names, std::span<const char* const> words);

}  // namespace twin::cli
