#pragma once

#include "core/error.hpp"
#include "hal/machine.hpp"

namespace twin::cli {

/// Lets a real machine move only when the user knows it: with --i-know-it-moves, or with a word
/// typed at a terminal. A simulated machine needs neither.
///
/// @param what  what it is about to do, as in "run dolphin.nc"
Expected<void> confirm_motion(const hal::MachineInfo& machine, bool is_known,
                              const std::string& what);

}  // namespace twin::cli
