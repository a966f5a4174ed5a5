#pragma once

#include <filesystem>
#include <vector>

#include "core/error.hpp"
#include "studies/identify/validation.hpp"

namespace twin::studies::identify {

/// Draws what predictions leave, beside filter and delay: validation_N_AXIS.png, .svg, .csv, .gp.
/// @param folder  is made when it is missing, unless there is nothing to draw
Expected<void> draw_validations(const std::vector<Validation>& validations,
                                const std::filesystem::path& folder);

}  // namespace twin::studies::identify
