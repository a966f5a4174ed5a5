#pragma once

#include <vector>

#include "nc_programs/generate/nc_text.hpp"

namespace twin::programs {

/// Every program of nc_programs/, as it is to be written.
/// @throws std::runtime_error if an outline cannot be rounded
std::vector<ProgramFile> all_programs();

}  // namespace twin::programs
