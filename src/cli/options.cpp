#include "cli/options.hpp"

#include <fmt/format.h>

#include "config/find_file.hpp"
#include "config/nearest_name.hpp"
#include "convert/dialect.hpp"
#include "core/units.hpp"

namespace twin::cli {

namespace {

/// Empty for the name of a dialect, else what is wrong with it.
std::string check_dialect(const std::string& name) {
  if (convert::make_dialect(name) != nullptr) {
    return {};
  }
  const std::vector<std::string> names = convert::dialect_names();
  return fmt::format("unknown dialect {}{} (there are {})", name, config::did_you_mean(name, names),
                     fmt::join(names, ", "));
}

}  // namespace

void add_program_options(CLI::App& command, Options& options) {
  command
      .add_option("program", options.programs,
                  "NC program: a file, or the name of one in nc_programs")
      ->required()
      ->expected(1)
      ->type_name("PROGRAM.nc");
  command
      .add_option("--feedrate-mm-per-min", options.feedrate_mm_per_min,
                  "Feedrate in place of the program's F words")
      ->check(CLI::Range(1e-3, 1e6))
      ->type_name("F");
}

void add_planning_options(CLI::App& command, Options& options) {
  add_program_options(command, options);
  add_machine_options(command, options);
}

void add_machine_file_options(CLI::App& command, Options& options) {
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

void add_machine_options(CLI::App& command, Options& options) {
  add_machine_file_options(command, options);
  command
      .add_option("--interpolator", options.interpolator,
                  "What runs of short blocks become: nurbs (C2 curves), bezier (Fast Bezier), "
                  "linear (nothing else) [of the machine file: nurbs]")
      ->check(CLI::IsMember({"nurbs", "bezier", "linear"}))
      ->type_name("NAME");
}

void add_convert_options(CLI::App& command, Options& options) {
  add_planning_options(command, options);
  command
      .add_option("--to", options.dialect,
                  "g5.2: LinuxCNC; g6.2: LinuxCNC 2.10; fanuc: G06.2; bspline: SINUMERIK")
      ->required()
      ->check(check_dialect)
      ->type_name("DIALECT");
  command.add_option("--out", options.out, "File to write [renders/PROGRAM/PROGRAM.DIALECT.nc]")
      ->type_name("FILE");
  command.add_flag("--quiet", options.quiet, "Print errors only");
}

void add_hal_option(CLI::App& command, Options& options) {
  command
      .add_option("--hal", options.hal,
                  "Machine: mujoco is the simulated table, ideal has position = set point")
      ->check(CLI::IsMember({"mujoco", "ideal"}))
      ->type_name("NAME")
      ->capture_default_str();
}

void add_result_options(CLI::App& command, Options& options) {
  command.add_option("--out", options.out, "Folder of the results [renders/PROGRAM]")
      ->type_name("DIR");
  command.add_flag("--no-plots", options.no_plots, "Write no figures");
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
