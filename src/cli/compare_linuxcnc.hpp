#pragma once

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"

namespace twin::cli {

/// twin compare --with linuxcnc: programs under this controller and under LinuxCNC, on one table.
Expected<void> compare_with_linuxcnc(const CompareArguments& arguments,
                                     const Environment& environment);

}  // namespace twin::cli
