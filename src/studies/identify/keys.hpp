#pragma once

#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"

namespace twin::studies::identify {

/// Full keys of parameters that a trace can be fitted for: "table.x.moving_mass" is
/// "table.x.moving_mass_kg".
///
/// @param names    as a user gives them, with or without the unit
/// @param machine  whose parameters they are
/// @returns the keys in the order of the names, or a kUsage error that says what was meant
Expected<std::vector<std::string>> full_keys(const std::vector<std::string>& names,
                                             const config::MachineFile& machine);

}  // namespace twin::studies::identify
