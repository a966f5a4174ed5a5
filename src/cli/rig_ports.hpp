#pragma once

#include <string>

#include "cli/options.hpp"

namespace twin::cli {

/// Name of the shared memory that an emulator's process has: --rig-name, or the user's own.
std::string shared_name(const Options& options);

}  // namespace twin::cli
