#pragma once

#include <string>

#include "core/error.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig::assemble {

/// What stands behind the registers.
enum class RigKind {
  kCards,     ///< the real cards: metal moves
  kProcess,   ///< emulated boards of another process, `twin rig emulate`, on the wall clock
  kEmulated,  ///< emulated boards in this process, in simulated time
};

/// "real cards", "emulated boards (simulated)".
std::string describe(RigKind kind);

/// Finds out which rig is meant.
///
/// "auto" is the real cards or an emulator's process, whichever is there; that both are there is an
/// error, and that neither is one that names what was looked for.
/// @param wanted       "auto", "cards", "process" or "emulated"
/// @param shared_name  of the shared memory of an emulator's process
Expected<RigKind> find_rig(const std::string& wanted, const RigSettings& wiring,
                           const std::string& shared_name);

}  // namespace twin::hal::rig::assemble
