#pragma once

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"

/// The command line is two programs, so that a run needs no studies: `twin` has the commands of one
/// run, and hands the others over to `twin-studies`, which has all.
namespace twin::cli {

/// The commands that a program has.
struct Commands {
  bool (*has)(const Arguments& arguments);
  Expected<void> (*execute)(const Arguments& arguments, const Environment& environment);
};

/// The body of main(): reads the command line, watches for signals, executes the command and says
/// what went wrong. A command that this program does not have is handed over to `twin-studies`, with
/// the same words in the same process.
///
/// @returns the exit status
int run_command_line(int argc, char** argv, const Commands& commands);

}  // namespace twin::cli
