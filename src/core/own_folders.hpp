#pragma once

#include <filesystem>
#include <vector>

namespace twin {

/// Folders that this code was loaded from: that of the shared library or program that holds it, then
/// that of the running program if it is another one. What belongs to an installed program is found
/// beside them.
std::vector<std::filesystem::path> own_folders();

}  // namespace twin
