#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/arguments.hpp"
#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "hal/machine.hpp"
#include "hal/mujoco/change.hpp"
#include "hal/rig/assemble/make_rig.hpp"
#include "hal/rig/assemble/rig_ports.hpp"
#include "hal/rig/rig_machine.hpp"
#include "session/machine.hpp"
#include "session/pictures.hpp"

/// From the options of a command to program, machine file, machine and rig.
namespace twin::cli {

/// Reads the program that a command names.
///
/// @param machine  names the folders of subprograms
/// @param out      folder of the results, where the copy of a long program is kept; may be empty
Expected<gcode::ProgramText> read_program(const std::string& name, const MachineArguments& machine,
                                          const std::atomic<bool>& stop,
                                          const std::filesystem::path& out = {});

/// The machine file with the settings of the command line. What the reader notes of it is printed
/// on stderr unless the command is quiet.
Expected<config::MachineFile> read_machine(const MachineArguments& arguments, Verbosity verbosity);

/// What makes the machine of --hal. A real one is confirmed by the user first.
/// @param plant  settings of the simulated or emulated table that the controller does not know
session::MakeMachine machine_of(const HalArguments& arguments,
                                const std::vector<std::string>& plant = {});

/// The program of a trace, where it is still there and still the same: by its name, or by the path
/// that the command line of the run had.
std::optional<gcode::ProgramText> program_of(const session::TraceOrigin& origin,
                                             const std::atomic<bool>& stop);

/// What of the simulated table changes, as --change says it.
Expected<std::vector<hal::mujoco::Change>> read_changes(const std::vector<std::string>& texts);

/// "x" or "y" as an axis.
hal::Axis axis_of(const std::string& name);

/// Name of the shared memory of an emulator's process: that of --rig-name, or the user's own.
std::string shared_name(const RigArguments& arguments);

/// The rig of --rig put together, and confirmed by the user if it is real.
///
/// @param purpose  what it is about to do, as in "run dolphin.nc"
Expected<std::unique_ptr<hal::Machine>> open_rig(const RigArguments& arguments,
                                                 const config::MachineFile& machine,
                                                 const std::string& purpose);

/// Name of the rig that is a machine behind LinuxCNC's HAL, for --rig, and for --hal as well.
inline constexpr const char* kLinuxCnc = "linuxcnc";

/// The machine behind LinuxCNC's HAL, unconfigured.
std::unique_ptr<hal::Machine> make_linuxcnc_machine(const RigArguments& arguments,
                                                    const config::MachineFile& machine);

/// A rig that is only looked at.
struct RigToLookAt {
  config::MachineFile machine;
  hal::rig::assemble::RigKind kind = hal::rig::assemble::RigKind::kEmulated;
  hal::rig::RigSettings settings;  ///< wires; emulated cards always read V-REF back
  hal::rig::assemble::RigPorts ports;
};

/// Opens the registers of the rig without writing to them.
Expected<RigToLookAt> open_to_look(const RigArguments& arguments, config::MachineFile machine);

}  // namespace twin::cli
