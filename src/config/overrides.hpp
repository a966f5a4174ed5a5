#pragma once

#include <span>
#include <string>
#include <string_view>

#include "config/machine_file.hpp"

namespace twin::config {

/// Applies one `section.key=value`, as --set takes it.
///
/// The value is what would stand in the file; a text needs no quotes. Errors are kUsage and name
/// the nearest key.
Expected<void> apply_override(MachineFile& machine, std::string_view text);

/// Applies several in order, then checks what they say together (check_rules, resolve_planner).
Expected<void> apply_overrides(MachineFile& machine, std::span<const std::string> texts);

}  // namespace twin::config
