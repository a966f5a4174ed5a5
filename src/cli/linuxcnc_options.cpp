#include <CLI/CLI.hpp>

#include "cli/option_groups.hpp"
#include "cli/options.hpp"

// The options of the commands that meet LinuxCNC.
namespace twin::cli {

void add_options(CLI::App& command, PlantArguments& plant) {
  command.footer(
      "Examples:\n"
      "  twin plant\n"
      "  twin plant --program dolphin.nc --out renders/linuxcnc\n"
      "  twin plant --fault limit_positive:x@3");
  add_machine(command, plant.machine);
  command
      .add_option("--program", plant.program,
                  "NC program that LinuxCNC runs: recordings are held against it at the end")
      ->type_name("PROGRAM.nc");
  command.add_option("--out", plant.folder, "Folder of the recordings [renders/plant]")
      ->type_name("DIR");
  command.add_flag_callback(
      "--no-trace", [&plant] { plant.has_recording = false; }, "Record nothing");
  command.add_option("--name", plant.name, "Shared memory [/twin-plant-UID]")->type_name("/NAME");
  command.add_option("--for", plant.duration, "End after so much simulated time")
      ->check(CLI::PositiveNumber)
      ->type_name("SECONDS");
  add_changes(command, plant.changes);
  add_list(command, "--fault", plant.faults,
           "Break something of the table, as in --fault alarm:x@1.5 (repeatable)")
      ->type_name("KIND:AXIS@SECONDS");
}

void add_options(CLI::App& command, LinuxcncConfigArguments& config) {
  add_machine(command, config.machine);
  command.add_option("--out", config.folder, "Folder of the configuration [renders/linuxcnc]")
      ->type_name("DIR");
}

void add_options(CLI::App& command, LinuxcncEvaluateArguments& evaluate) {
  command.add_option("folder", evaluate.folder, "Folder of a recording of twin plant")
      ->required()
      ->type_name("DIR");
  command.add_option("program", evaluate.program, "NC program that LinuxCNC ran")
      ->required()
      ->type_name("PROGRAM.nc");
  add_machine(command, evaluate.machine);
  add_reading(command, evaluate.machine);
  add_no_plots(command, evaluate.has_plots);
}

}  // namespace twin::cli
