#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/error.hpp"

namespace twin::pictures {

/// Runs "gnuplot SCRIPT" in a directory and waits for it.
///
/// The program is started directly, without a shell, so that no name needs quoting.
///
/// @param directory  working directory, where script, data and pictures are
/// @param script     file name in that directory
/// @returns an Error when gnuplot is missing or fails, with the first line of its complaint
Expected<void> run_gnuplot(const std::filesystem::path& directory, const std::string& script);

/// Runs several scripts, two at a time. @returns the first error, after all have ended
Expected<void> run_gnuplot(const std::filesystem::path& directory,
                           std::span<const std::string> scripts);

}  // namespace twin::pictures
