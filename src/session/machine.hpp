#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/machine.hpp"

/// Where a run's machine comes from: its settings, and the machine itself.
namespace twin::session {

/// A machine file and what is changed of it.
struct MachineSource {
  std::string file{"xy_table.toml"};  ///< a path, or a name in the folder mjcf
  std::vector<std::string> settings;  ///< section.key=value, applied in this order
};

/// Finds and reads a machine file and applies the changes to it.
Expected<config::MachineFile> read_machine(const MachineSource& source);

/// Makes the machine that a run moves, unconfigured.
///
/// `purpose` says what the run is going to do, as in "run dolphin.nc": a function that makes real
/// machines shows it to the user whom it asks.
using MakeMachine = std::function<Expected<std::unique_ptr<hal::Machine>>(
    const config::MachineFile& machine, const std::string& purpose)>;

/// Makes a simulated machine.
///
/// @param name  "mujoco", the simulated table, or "ideal", whose position equals the set point
/// @returns the machine, or a kUsage error for another name
Expected<std::unique_ptr<hal::Machine>> make_simulated_machine(std::string_view name,
                                                               const config::MachineFile& machine);

/// The function that makes a simulated machine of this name.
MakeMachine simulated_machine(std::string name);

/// What the user has said about motion of a real machine.
enum class Consent {
  kNotAsked,
  kGiven,  ///< in advance: --i-know-it-moves
};

/// True if a user must agree before this machine may move: a real one always needs consent, a
/// simulated one never does.
bool needs_consent(const hal::MachineInfo& machine, Consent consent);

}  // namespace twin::session
