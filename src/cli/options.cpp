#include "cli/options.hpp"

#include <fmt/format.h>

#include "config/find_file.hpp"
#include "core/units.hpp"

namespace twin::cli {

void add_program_options(CLI::App& command, Options& options) {
  command
      .add_option("program", options.programs,
                  "NC program: a file, or the name of one in nc_programs")
      ->required()
      ->expected(1)
      ->type_name("PROGRAM.nc");
  add_feedrate_option(command, options);
}

void add_feedrate_option(CLI::App& command, Options& options, const std::string& text) {
  command.add_option("--feedrate-mm-per-min", options.feedrate_mm_per_min, text)
      ->check(CLI::Range(1e-3, 1e6))
      ->type_name("F");
}

void add_machine_options(CLI::App& command, Options& options) {
  command
      .add_option("--machine", options.machine, "Machine file: a file, or the name of one in mjcf")
      ->type_name("FILE.toml")
      ->capture_default_str();
  command
      .add_option(
          "--set", options.settings,
          "Change a setting of the machine file, as in --set limits.jerk=20000 (repeatable)")
      ->type_name("SECTION.KEY=VALUE")
      ->take_all()
      ->expected(1);
}

void add_interpolator_option(CLI::App& command, Options& options) {
  command
      .add_option("--interpolator", options.interpolator,
                  "What runs of short blocks become: nurbs (C2 curves), bezier (Fast Bezier), "
                  "linear (nothing else) [of the machine file: nurbs]")
      ->check(CLI::IsMember({"nurbs", "bezier", "linear"}))
      ->type_name("NAME");
}

void add_hal_option(CLI::App& command, Options& options, bool has_rig) {
  std::vector<std::string> names{"mujoco", "ideal"};
  if (has_rig) {
    names.emplace_back("rig");
  }
  command
      .add_option("--hal", options.hal,
                  fmt::format("Machine: mujoco is the simulated table, ideal has position = set "
                              "point{}",
                              has_rig ? ", rig is the real one or its emulation" : ""))
      ->check(CLI::IsMember(names))
      ->type_name("NAME")
      ->capture_default_str();
}

void add_rig_options(CLI::App& command, Options& options, bool can_move) {
  command
      .add_option("--rig", options.rig,
                  "Which rig: cards are the real ones, process is a running `twin rig emulate`, "
                  "emulated is in this process and in simulated time, auto is cards or process")
      ->check(CLI::IsMember({"auto", "cards", "process", "emulated"}))
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option("--rig-name", options.rig_name,
                  "Shared memory of the emulator's process [/twin-rig-UID]")
      ->type_name("/NAME");
  if (!can_move) {
    return;
  }
  command.add_flag("--i-know-it-moves", options.i_know_it_moves,
                   "Let a real machine move without asking");
  add_fault_option(command, options);
  command
      .add_option("--rig-log", options.rig_log,
                  "Write what happens at the boards of --rig emulated to this file")
      ->type_name("FILE");
}

void add_override_option(CLI::App& command, Options& options) {
  command
      .add_option("--override", options.overrides,
                  "Change the feed override while moving, as in 0:100,2:50,3.5:0,5:150: seconds "
                  "since the first set point, percent of the programmed feedrate (0 holds)")
      ->type_name("S:PERCENT,...");
}

void add_control_option(CLI::App& command, Options& options) {
  command
      .add_option("--control", options.control,
                  "On the wall clock: listen at a Unix domain socket of this name for override "
                  "PERCENT, hold, resume, status (you alone may connect)")
      ->type_name("PATH");
}

void add_axis_option(CLI::App& command, Options& options) {
  command.add_option("--axis", options.axis, "Axis")
      ->required()
      ->check(CLI::IsMember({"x", "y"}))
      ->type_name("x|y");
}

void add_fault_option(CLI::App& command, Options& options) {
  command
      .add_option("--fault", options.faults,
                  "Break something of the emulated rig, as in --fault alarm:x@1.5 (repeatable)")
      ->type_name("KIND[:AXIS]@SECONDS")
      ->take_all()
      ->expected(1);
}

void add_result_options(CLI::App& command, Options& options, const std::string& folder) {
  command.add_option("--out", options.out, "Folder of the results [renders/" + folder + "]")
      ->type_name("DIR");
  command.add_flag("--no-plots", options.no_plots, "Draw no figures");
  command.add_flag("--quiet", options.quiet, "Print errors only");
}

void add_video_options(CLI::App& command, Options& options) {
  command.add_flag("--video", options.video, "Render video.mp4, as long as the machining");
  command.add_option("--camera", options.camera, "Camera of the video")
      ->check(CLI::IsMember({"iso", "top"}))
      ->type_name("NAME")
      ->capture_default_str();
}

Expected<config::MachineFile> read_machine(const Options& options) {
  auto file = config::find_machine(options.machine);
  if (!file) {
    return tl::unexpected(file.error());
  }
  std::vector<std::string> settings = options.settings;
  if (!options.interpolator.empty()) {
    settings.push_back("interpolator.kind=" + options.interpolator);
  }
  return config::read_machine_file(*file, settings);
}

std::optional<double> feedrate_of(const Options& options) {
  if (!options.feedrate_mm_per_min) {
    return std::nullopt;
  }
  return units::mm_per_s_from_mm_per_min(*options.feedrate_mm_per_min);
}

std::filesystem::path result_folder(const Options& options, const std::filesystem::path& program) {
  return options.out.empty() ? std::filesystem::path("renders") / program.stem() : options.out;
}

}  // namespace twin::cli
