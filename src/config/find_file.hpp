#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace twin::config {

/// The machine file that is used when none is named.
inline constexpr std::string_view kDefaultMachine = "xy_table.toml";

/// Folders of this name that belong to the program, best first: below the current directory, of the
/// installation (share/twin beside the bin folder of the executable), of the source tree, of the
/// build. Those that do not exist are left out.
std::vector<std::filesystem::path> data_folders(std::string_view name);

/// A file by path, else by name in the first of some folders that has it; the extension may be left
/// out.
///
/// @param kind       what it is, for the message: "NC program"
/// @param extension  with the dot: ".nc"
/// @returns the path, or a kFile error that says where it was looked for and names the nearest file
/// there is
Expected<std::filesystem::path> find_file(std::string_view kind, const std::string& name,
                                          std::string_view extension,
                                          std::span<const std::filesystem::path> folders);

/// An NC program: a path, with or without .nc, .ngc, .gcode or .tap; a name in nc_programs; or "-"
/// for standard input.
Expected<std::filesystem::path> find_program(const std::string& name);

/// A machine file: a path, or a name in mjcf.
Expected<std::filesystem::path> find_machine(
    const std::string& name = std::string(kDefaultMachine));

}  // namespace twin::config
