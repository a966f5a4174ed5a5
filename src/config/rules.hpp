#pragma once

#include "config/machine_file.hpp"

namespace twin::config {

/// Checks what no single key can know: that ends of travel are in order and min_segments is at most
/// max_segments, and that no line of the rig is used twice.
///
/// What the table's settings say together (a whole number of physics steps in a period) the table
/// checks itself, for a plan does not need it. @returns kFile error with the keys and values that
/// do not fit
Expected<void> check_rules(const MachineFile& machine);

}  // namespace twin::config
