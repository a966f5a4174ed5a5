#pragma once

#include <vector>

#include "config/machine_file.hpp"
#include "core/setting.hpp"

namespace twin::config {

/// All settings of a machine as values, in the order and the units of to_toml().
std::vector<Setting> settings_of(const MachineFile& machine);

}  // namespace twin::config
