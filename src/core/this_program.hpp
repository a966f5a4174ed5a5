#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What the running program says of itself: its version, where it was loaded from, how it was
/// called.
namespace twin {

/// Version of this project, as in "0.9.0".
std::string_view version() noexcept;

/// Folders that this code was loaded from: that of the shared library or program that holds it, then
/// that of the running program if it is another one. What belongs to an installed program is found
/// beside them.
std::vector<std::filesystem::path> own_folders();

/// The program of this name beside the running one, whether it is there or not.
std::filesystem::path program_beside(std::string_view name);

/// Words as one line that a POSIX shell would take apart into the same words:
///   twin run 'my program.nc'
std::string shell_quoted(std::span<const char* const> words);

}  // namespace twin
