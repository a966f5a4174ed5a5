#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"

namespace twin::cli {

/// Options that the subcommands share; each takes those that mean something to it.
struct Options {
  std::string command;                    ///< the whole command line, as a shell takes it
  std::vector<std::string> programs;      ///< as given: paths, or names in nc_programs
  std::string machine = "xy_table.toml";  ///< path, or name in mjcf
  std::string hal = "mujoco";
  std::string interpolator;  ///< empty: that of the machine file
  std::optional<double> feedrate_mm_per_min;
  double radius_mm = 20.0;            ///< of the circular test
  std::vector<std::string> settings;  ///< section.key=value
  std::filesystem::path out;          ///< folder of the results; empty: renders/NAME
  std::string dialect;                ///< of convert; then `out` is a file
  std::string camera = "iso";
  std::string rig = "auto";         ///< which rig --hal rig means
  std::string rig_name;             ///< of the emulator's shared memory; empty: the user's own
  std::filesystem::path rig_log;    ///< events at the emulated boards; empty: none
  std::vector<std::string> faults;  ///< injected into emulated boards: KIND[:AXIS]@SECONDS
  bool i_know_it_moves = false;
  std::string axis;               ///< x or y, of rig jog and rig home
  double distance_mm = 0.0;       ///< of rig jog
  std::optional<double> for_s;    ///< how long rig monitor and rig emulate run
  int repeats = 10;               ///< of the runs of reproduce, with other phases
  std::string overrides;          ///< seconds:percent, ...
  std::filesystem::path control;  ///< control socket; empty: none
  bool video = false;
  bool no_plots = false;
  bool realtime = false;
  bool bound = false;  ///< of plan: the lower bound of the time too
  bool quiet = false;
};

/// The NC program and --feedrate-mm-per-min.
void add_program_options(CLI::App& command, Options& options);
/// --feedrate-mm-per-min alone.
void add_feedrate_option(CLI::App& command, Options& options,
                         const std::string& text = "Feedrate in place of the program's F words");
/// --machine and --set.
void add_machine_options(CLI::App& command, Options& options);
/// --interpolator.
void add_interpolator_option(CLI::App& command, Options& options);
/// --hal. @param has_rig  whether the rig is among the choices
void add_hal_option(CLI::App& command, Options& options, bool has_rig = false);
/// --axis, one that must be given.
void add_axis_option(CLI::App& command, Options& options);
/// --fault.
void add_fault_option(CLI::App& command, Options& options);
/// --rig, --rig-name, and with motion --i-know-it-moves, --fault, --rig-log.
void add_rig_options(CLI::App& command, Options& options, bool can_move);
/// --override.
void add_override_option(CLI::App& command, Options& options);
/// --control.
void add_control_option(CLI::App& command, Options& options);
/// --out, --no-plots, --quiet. @param folder  below renders, where results go without --out
void add_result_options(CLI::App& command, Options& options, const std::string& folder = "PROGRAM");
/// --video and --camera.
void add_video_options(CLI::App& command, Options& options);

/// The machine file with the settings of the command line.
Expected<config::MachineFile> read_machine(const Options& options);

/// Programmed feedrate of --feedrate-mm-per-min, in base units [mm/s].
std::optional<double> feedrate_of(const Options& options);

/// Folder of the results of a program.
std::filesystem::path result_folder(const Options& options, const std::filesystem::path& program);

}  // namespace twin::cli
