#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>

namespace twin::cli {

/// One line about a command line that cannot be parsed; names the nearest command or option.
///
/// @param app        with its subcommands
/// @param error      what the parser says
/// @param arguments  the command line without the program's name
std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        std::span<const char* const> arguments);

}  // namespace twin::cli
