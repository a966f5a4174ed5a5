#include "cli/option_groups.hpp"

#include <CLI/CLI.hpp>

#include "core/program_settings.hpp"
#include "core/units.hpp"

namespace twin::cli {

void begin_group(CLI::App& command, const std::string& name) {
  command.option_defaults()->group(name);
}

// Groups of options.

CLI::Option* add_feedrate(CLI::App& command, std::optional<double>& feedrate,
                          const std::string& text) {
  const auto take = [&feedrate](double given) {
    feedrate = units::mm_per_s_from_mm_per_min(given);
  };
  return command.add_option_function<double>("--feedrate-mm-per-min", take, text)
      ->check(CLI::Range(1e-3, 1e6))
      ->type_name("F");
}

void add_program_name(CLI::App& command, std::string& name) {
  const auto take = [&name](const std::vector<std::string>& given) { name = given.front(); };
  command
      .add_option_function<std::vector<std::string>>(
          "program", take, "NC program: a file, or the name of one in nc_programs")
      ->required()
      ->expected(1)
      ->type_name("PROGRAM.nc");
}

void add_program(CLI::App& command, ProgramArguments& program) {
  add_program_name(command, program.name);
  add_feedrate(command, program.feedrate);
}

CLI::Option* add_list(CLI::App& command, const std::string& name, std::vector<std::string>& list,
                      const std::string& text) {
  return command.add_option(name, list, text)->take_all()->expected(1)->allow_extra_args(false);
}

CLI::Option* add_machine_file(CLI::App& command, MachineArguments& machine,
                              const std::string& text) {
  return command.add_option("--machine", machine.file, text)
      ->type_name("FILE.toml")
      ->capture_default_str();
}

void add_machine(CLI::App& command, MachineArguments& machine) {
  add_machine_file(command, machine, "Machine file: a file, or the name of one in mjcf");
  add_list(command, "--set", machine.settings,
           "Change a setting of the machine file, as in --set limits.jerk=20000 (repeatable)")
      ->type_name("SECTION.KEY=VALUE");
}

/// How programs are read.
void add_reading(CLI::App& command, MachineArguments& machine) {
  const std::vector<std::string> dialects(kDialectNames.begin(), kDialectNames.end());
  command
      .add_option("--dialect", machine.dialect,
                  "Whose language the program is written in: auto (as its text shows), linuxcnc, "
                  "fanuc, grbl [of the machine file: auto]")
      ->check(CLI::IsMember(dialects))
      ->type_name("NAME");
  command
      .add_option("--ignore-axes", machine.ignored_axes,
                  "Leave out the words of these axes, letters of abcuvw")
      ->type_name("LETTERS");
  command
      .add_option(
          "--subprograms", machine.subprogram_folders,
          "Look here for files of subprograms, behind the program's own folder (repeatable)")
      ->take_all()
      ->expected(1)
      ->type_name("DIR");
  command.add_option("--offset-mm", machine.offset_mm, "Where the program's origin lies")
      ->type_name("X,Y,Z");
  command.add_option("--tool-table", machine.tool_table, "Lengths and diameters of tools")
      ->type_name("FILE.tbl");
}

void add_curves(CLI::App& command, MachineArguments& machine) {
  const std::vector<std::string> kinds{"nurbs", "bezier", "linear"};
  command
      .add_option("--curves", machine.curves,
                  "What runs of short blocks become: nurbs (C2 curves), bezier (Fast Bezier), "
                  "linear (nothing else) [of the machine file: nurbs]")
      ->check(CLI::IsMember(kinds))
      ->type_name("NAME");
  const auto take = [&machine](const std::string& given) {
    machine.curves = given;
    machine.has_old_name_of_curves = true;
  };
  command.add_option_function<std::string>("--interpolator", take, "Old name of --curves")
      ->check(CLI::IsMember(kinds))
      ->type_name("NAME")
      ->excludes("--curves");
}

void add_simulated_hal(CLI::App& command, std::string& hal) {
  command
      .add_option("--hal", hal,
                  "Machine: mujoco is the simulated table, ideal has position = set point")
      ->check(CLI::IsMember({"mujoco", "ideal"}))
      ->type_name("NAME")
      ->capture_default_str();
}

void add_faults(CLI::App& command, std::vector<std::string>& faults) {
  add_list(command, "--fault", faults,
           "Break something of the emulated rig, as in --fault alarm:x@1.5 (repeatable)")
      ->type_name("KIND[:AXIS]@SECONDS");
}

void add_changes(CLI::App& command, std::vector<std::string>& changes) {
  add_list(command, "--change", changes,
           "Let something of the simulated table change while it runs, at once or slowly, as in "
           "--change friction:x=1.3@2 or vref_gain:y=0.95@1+5 (repeatable)")
      ->type_name("KIND:AXIS=VALUE@SECONDS[+RAMP]");
}

void add_shadow(CLI::App& command, ShadowArguments& shadow) {
  const auto take = [&shadow](const std::vector<std::string>& given) {
    shadow.is_wanted = true;
    shadow.file = given.empty() ? "" : given.front();
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--shadow", take,
          "Let the identified table run beside the machine and say what changes of it; FILE "
          "(behind "
          "PROGRAM) is what twin shadow --learn has learnt of healthy runs")
      ->expected(0, 1)
      ->allow_extra_args(false)
      ->type_name("FILE.json");
}

void add_rig(CLI::App& command, RigArguments& rig) {
  command
      .add_option(
          "--rig", rig.which,
          "Which rig: cards are the real ones, process is a running `twin rig emulate`, "
          "emulated is in this process and in simulated time, linuxcnc is what LinuxCNC's HAL "
          "drives, auto is cards or process")
      ->check(CLI::IsMember({"auto", "cards", "process", "emulated", "linuxcnc"}))
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option(
          "--rig-name", rig.name,
          "Shared memory of the emulator's process or of LinuxCNC's component [/twin-rig-UID, "
          "/twin-controller-UID]")
      ->type_name("/NAME");
}

void add_moving_rig(CLI::App& command, RigArguments& rig) {
  add_rig(command, rig);
  command.add_flag("--i-know-it-moves", rig.is_known_to_move,
                   "Let a real machine move without asking");
  add_faults(command, rig.faults);
  command
      .add_option("--rig-log", rig.log,
                  "Write what happens at the boards of --rig emulated to this file")
      ->type_name("FILE");
}

void add_hal(CLI::App& command, HalArguments& hal) {
  command
      .add_option("--hal", hal.name,
                  "Machine: mujoco is the simulated table, ideal has position = set point, rig is "
                  "the real one or its emulation, linuxcnc is what LinuxCNC's HAL drives")
      ->check(CLI::IsMember({"mujoco", "ideal", "rig", "linuxcnc"}))
      ->type_name("NAME")
      ->capture_default_str();
  add_changes(command, hal.rig.changes);
  begin_group(command, "Rig, with --hal rig or linuxcnc");
  add_moving_rig(command, hal.rig);
}

void add_correction(CLI::App& command, CorrectionArguments& correction) {
  const auto take = [&correction](const std::vector<std::string>& given) {
    correction.is_wanted = true;
    correction.file = given.empty() ? "" : given.front();
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--compensate", take,
          "Shift the set points as FILE of twin compensate says; without FILE (behind PROGRAM) "
          "make "
          "the correction now")
      ->expected(0, 1)
      ->allow_extra_args(false)
      ->type_name("FILE.csv");
  command
      .add_option("--learn", correction.learning,
                  "Follow the correction in this folder, and make it better by what this run "
                  "measures; the first run makes it by the model")
      ->type_name("DIR");
  add_list(command, "--set-plant", correction.plant,
           "Change a setting of the simulated table alone: the controller and its model do not "
           "know (repeatable)")
      ->type_name("SECTION.KEY=VALUE");
}

CLI::Option* add_tolerance(CLI::App& command, const std::string& name, const std::string& text,
                           const std::function<void(double)>& take) {
  return command
      .add_option_function<double>(
          name, [take](double um) { take(units::mm_from_um(um)); }, text)
      ->check(CLI::Range(1e-3, 1e5))
      ->type_name("T");
}

void add_overrides(CLI::App& command, std::string& overrides) {
  command
      .add_option("--override", overrides,
                  "Change the feed override while moving, as in 0:100,2:50,3.5:0,5:150: seconds "
                  "since the first set point, percent of the programmed feedrate (0 holds)")
      ->type_name("S:PERCENT,...");
}

void add_quiet(CLI::App& command, Verbosity& verbosity, const std::string& text) {
  command.add_flag_callback(
      "--quiet", [&verbosity] { verbosity = Verbosity::kQuiet; }, text);
}

void add_no_plots(CLI::App& command, bool& has_plots) {
  command.add_flag_callback(
      "--no-plots", [&has_plots] { has_plots = false; }, "Draw no figures");
}

void add_paper(CLI::App& command, pictures::Paper& paper) {
  command.add_flag_callback(
      "--pdf", [&paper] { paper = pictures::Paper::kToo; },
      "Plots for a paper as well: PDF, one column wide");
}

void add_results(CLI::App& command, ResultArguments& results, const std::string& folder) {
  command.add_option("--out", results.folder, "Folder of the results [renders/" + folder + "]")
      ->type_name("DIR");
  add_no_plots(command, results.has_plots);
  add_quiet(command, results.verbosity);
}

void add_trace(CLI::App& command, ResultArguments& results, bool has_none) {
  const auto take = [&results](const std::string& name) {
    results.trace = *results::trace_files_of(name);
  };
  const auto last = results::kTraceFilesNames.end() - (has_none ? 0 : 1);
  command
      .add_option_function<std::string>(
          "--trace", take,
          std::string("Files of the trace: csv (trace.csv), hdf5 (trace.h5), both") +
              (has_none ? ", none [csv]" : " [csv]"))
      ->check(CLI::IsMember(std::vector<std::string>(results::kTraceFilesNames.begin(), last)))
      ->type_name("FORMAT");
}

void add_run_results(CLI::App& command, ResultArguments& results) {
  add_results(command, results);
  add_paper(command, results.paper);
  command.add_flag_callback(
      "--no-report", [&results] { results.has_page = false; }, "Write no report.html");
  command
      .add_option("--columns", results.columns,
                  "Columns of the trace: names, default, all, as in default,path_mm,x_torque_Nm")
      ->type_name("NAME,...");
  add_trace(command, results, true);
  command.add_flag_callback(
      "--no-trace", [&results] { results.trace = results::TraceFiles::kNone; },
      "Write the summary alone, as --trace none: no plots and no report");
  command.add_flag("--json", results.has_json, "Print summary.json in place of the table");
}

void add_last_results(CLI::App& command, ResultArguments& results, const std::string& text) {
  command.add_option("--out", results.folder, text)->type_name("DIR");
  add_quiet(command, results.verbosity);
}

void add_video(CLI::App& command, VideoArguments& video) {
  command.add_flag("--video", video.is_wanted, "Render video.mp4, as long as the machining");
  command.add_option("--camera", video.camera, "Camera of the video; implies --video")
      ->check(CLI::IsMember({"iso", "top", "follow"}))
      ->each([&video](const std::string&) { video.is_wanted = true; })
      ->type_name("NAME")
      ->capture_default_str();
}

void add_axis(CLI::App& command, std::string& axis) {
  command.add_option("--axis", axis, "Axis")
      ->required()
      ->check(CLI::IsMember({"x", "y"}))
      ->type_name("x|y");
}

void add_duration(CLI::App& command, std::optional<double>& duration) {
  command.add_option("--for", duration, "End after so long")
      ->check(CLI::PositiveNumber)
      ->type_name("SECONDS");
}

}  // namespace twin::cli
