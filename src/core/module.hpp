#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/error.hpp"

/// Parts of the program that are loaded when they are first needed, since the libraries behind them
/// take longer to load than all the rest.
namespace twin {

/// A part of the program in a shared object of its own.
struct Module {
  std::string_view file;      ///< its name, as in "twin-video.so"
  std::string_view function;  ///< name of its one function
  std::string_view purpose;   ///< for messages, as in "the video's renderer"
};

/// Places where a module is looked for, in their order: lib/twin beside the program or the library
/// that holds this function, then where the project was built or installed.
std::vector<std::filesystem::path> module_places(std::string_view file);

/// Address of a module's function. The first call loads the module, which stays loaded. Thread-safe.
///
/// @returns a kFile error that names the places searched when there is no module
Expected<void*> load_module(const Module& module);

/// The same with the module in this file. @returns a kFile error with the loader's words when it
/// cannot be loaded
Expected<void*> load_module_from(const std::filesystem::path& file, const Module& module);

}  // namespace twin
