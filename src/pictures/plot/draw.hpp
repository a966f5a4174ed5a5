#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "pictures/plot/scripts.hpp"

namespace twin::pictures {

/// Writes each script as NAME.gp into a folder and runs it there; a script makes NAME.png and
/// NAME.svg.
///
/// @returns the pictures; after an error there are none, an older run's neither
Expected<std::vector<std::filesystem::path>> draw(const std::filesystem::path& folder,
                                                  std::span<const Script> scripts);

}  // namespace twin::pictures
