#include "cli/options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <system_error>

#include "cli/commands.hpp"
#include "core/units.hpp"

namespace twin::cli {
namespace {

// Groups of options.

CLI::Option* add_feedrate(CLI::App& command, std::optional<double>& feedrate,
                          const std::string& text = "Feedrate in place of the program's F words") {
  const auto take = [&feedrate](double given) {
    feedrate = units::mm_per_s_from_mm_per_min(given);
  };
  return command.add_option_function<double>("--feedrate-mm-per-min", take, text)
      ->check(CLI::Range(1e-3, 1e6))
      ->type_name("F");
}

void add_program(CLI::App& command, ProgramArguments& program) {
  const auto take = [&program](const std::vector<std::string>& given) {
    program.name = given.front();
  };
  command
      .add_option_function<std::vector<std::string>>(
          "program", take, "NC program: a file, or the name of one in nc_programs")
      ->required()
      ->expected(1)
      ->type_name("PROGRAM.nc");
  add_feedrate(command, program.feedrate);
}

CLI::Option* add_list(CLI::App& command, const std::string& name, std::vector<std::string>& list,
                      const std::string& text) {
  return command.add_option(name, list, text)->take_all()->expected(1);
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

/// The rig that is looked at.
void add_rig(CLI::App& command, RigArguments& rig) {
  command
      .add_option("--rig", rig.which,
                  "Which rig: cards are the real ones, process is a running `twin rig emulate`, "
                  "emulated is in this process and in simulated time, auto is cards or process")
      ->check(CLI::IsMember({"auto", "cards", "process", "emulated"}))
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option("--rig-name", rig.name, "Shared memory of the emulator's process [/twin-rig-UID]")
      ->type_name("/NAME");
}

/// The rig that moves.
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
                  "the real one or its emulation")
      ->check(CLI::IsMember({"mujoco", "ideal", "rig"}))
      ->type_name("NAME")
      ->capture_default_str();
  add_moving_rig(command, hal.rig);
}

void add_overrides(CLI::App& command, std::string& overrides) {
  command
      .add_option("--override", overrides,
                  "Change the feed override while moving, as in 0:100,2:50,3.5:0,5:150: seconds "
                  "since the first set point, percent of the programmed feedrate (0 holds)")
      ->type_name("S:PERCENT,...");
}

void add_quiet(CLI::App& command, Verbosity& verbosity,
               const std::string& text = "Print errors only") {
  command.add_flag_callback(
      "--quiet", [&verbosity] { verbosity = Verbosity::kQuiet; }, text);
}

void add_no_plots(CLI::App& command, bool& has_plots) {
  command.add_flag_callback(
      "--no-plots", [&has_plots] { has_plots = false; }, "Draw no figures");
}

void add_results(CLI::App& command, ResultArguments& results,
                 const std::string& folder = "PROGRAM") {
  command.add_option("--out", results.folder, "Folder of the results [renders/" + folder + "]")
      ->type_name("DIR");
  add_no_plots(command, results.has_plots);
  add_quiet(command, results.verbosity);
}

/// What a run or a plan leaves and says.
void add_run_results(CLI::App& command, ResultArguments& results) {
  add_results(command, results);
  command.add_flag_callback(
      "--no-report", [&results] { results.has_page = false; }, "Write no report.html");
  command
      .add_option("--columns", results.columns,
                  "Columns of trace.csv: names, default, all, as in default,path_mm,x_torque_Nm")
      ->type_name("NAME,...");
  command.add_flag_callback(
      "--no-trace", [&results] { results.has_trace = false; },
      "Write the summary alone: no trace, and so no plots and no report");
  command.add_flag("--json", results.has_json, "Print summary.json in place of the table");
}

/// Results of which there are no plots.
void add_last_results(CLI::App& command, ResultArguments& results, const std::string& text) {
  command.add_option("--out", results.folder, text)->type_name("DIR");
  add_quiet(command, results.verbosity);
}

void add_video(CLI::App& command, VideoArguments& video) {
  command.add_flag("--video", video.is_wanted, "Render video.mp4, as long as the machining");
  command.add_option("--camera", video.camera, "Camera of the video")
      ->check(CLI::IsMember({"iso", "top"}))
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

}  // namespace

void add_options(CLI::App& command, RunArguments& run) {
  add_program(command, run.program);
  add_machine(command, run.machine);
  add_curves(command, run.machine);
  add_overrides(command, run.overrides);
  add_hal(command, run.hal);
  command.add_flag("--realtime", run.is_on_wall_clock,
                   "Keep to the wall clock; keys: + - 0 to 9 feed override, space feed hold");
  command
      .add_option("--control", run.control,
                  "On the wall clock: listen at a Unix domain socket of this name for override "
                  "PERCENT, hold, resume, status (you alone may connect)")
      ->check([](const std::string& name) {
        return std::string(name.empty() ? "the socket needs a name" : "");
      })
      ->type_name("PATH");
  add_run_results(command, run.results);
  add_video(command, run.video);
}

void add_options(CLI::App& command, PlanArguments& plan) {
  add_program(command, plan.program);
  add_machine(command, plan.machine);
  add_curves(command, plan.machine);
  command.add_flag("--bound", plan.has_bound,
                   "The lower bound of the time as well: the same path without jerk limit");
  add_overrides(command, plan.overrides);
  add_run_results(command, plan.results);
}

void add_options(CLI::App& command, CheckArguments& check) {
  command.add_option("programs", check.programs, "NC programs: files, or names in nc_programs")
      ->required()
      ->type_name("PROGRAM.nc ...");
  add_feedrate(command, check.feedrate);
  add_machine(command, check.machine);
  add_quiet(command, check.verbosity);
}

void add_options(CLI::App& command, RenderArguments& render) {
  command.add_option("directory", render.folder, "Folder of an earlier run")
      ->required()
      ->type_name("DIR");
  add_machine_file(command, render.machine, "Machine file whose model the video shows");
  add_no_plots(command, render.has_plots);
  add_quiet(command, render.verbosity);
  add_video(command, render.video);
}

void add_options(CLI::App& command, ReportArguments& report) {
  command
      .add_option("directories", report.folders,
                  "Folders of earlier runs; several are shown on one page, over each other")
      ->required()
      ->type_name("DIR ...");
  command
      .add_option("--out", report.file,
                  "The page to write [DIR/report.html, of several runs renders/report.html]")
      ->type_name("FILE.html");
  add_quiet(command, report.verbosity);
}

void add_options(CLI::App& command, CompareArguments& compare) {
  command
      .add_option("program", compare.programs,
                  "NC programs: files, or names of some in nc_programs; more than one are planned "
                  "only, a line each program and planner")
      ->required()
      ->type_name("PROGRAM.nc");
  add_feedrate(command, compare.feedrate);
  add_machine(command, compare.machine);
  add_simulated_hal(command, compare.hal);
  add_results(command, compare.results, "PROGRAM_compare");
}

void add_options(CLI::App& command, ReproduceArguments& reproduce) {
  add_machine(command, reproduce.machine);
  command
      .add_option("--repeats", reproduce.repeats, "Runs a row with other encoder and hum phases")
      ->check(CLI::Range(0, 1000))
      ->type_name("N")
      ->capture_default_str();
  add_results(command, reproduce.results, "reproduce");
}

void add_options(CLI::App& command, CircleArguments& circle) {
  command.add_option("--radius-mm", circle.radius, "Radius of the circle about X0 Y0")
      ->type_name("R")
      ->capture_default_str();
  add_feedrate(command, circle.feedrate, "Feedrate [3000]");
  add_machine(command, circle.machine);
  add_curves(command, circle.machine);
  add_hal(command, circle.hal);
  add_results(command, circle.results, "circle");
}

void add_options(CLI::App& command, IdentifyArguments& identify) {
  command
      .add_option("traces", identify.traces,
                  "Traces: trace.csv of a run, or any CSV of time, command and measured position")
      ->type_name("TRACE.csv ...");
  command.add_flag("--tables", identify.has_tables,
                   "Fit Tables 4 and 5 of Wang and Yau's paper in place of traces");
  add_machine(command, identify.machine);
  command
      .add_option("--columns", identify.columns,
                  "Columns of foreign traces, as in t=time:ms,x_cmd=ref,x_meas=pos:um; signals t, "
                  "x_cmd, x_meas, x_V, y_cmd, y_meas, y_V; units s ms us m mm um V mV")
      ->type_name("SIGNAL=COLUMN[:UNIT],...");
  command
      .add_option("--out", identify.file,
                  "Machine file to write; identify.json is put beside it "
                  "[renders/identify/identified.toml]")
      ->type_name("FILE.toml");
  add_list(command, "--fix", identify.fixed,
           "Keys that keep their value, as in table.x.output_delay_ms")
      ->delimiter(',')
      ->type_name("KEY,...");
  add_list(command, "--free", identify.freed,
           "Keys to fit though others would be taken first, as in table.x.moving_mass_kg")
      ->delimiter(',')
      ->type_name("KEY,...");
  command.add_option("--seed", identify.seed, "Of the global search; same seed, same result")
      ->capture_default_str();
  command
      .add_option("--evaluations", identify.evaluations,
                  "Simulations of the global search at most [1200 an axis; tables: 1700]")
      ->check(CLI::Range(0, 10000000))
      ->type_name("N");
  add_quiet(command, identify.verbosity, "Print errors and notes only");
}

void add_options(CLI::App& command, ConvertArguments& convert) {
  add_program(command, convert.program);
  command
      .add_option("--to", convert.dialect,
                  "g5.2: LinuxCNC; g6.2: LinuxCNC 2.10; fanuc: G06.2; bspline: SINUMERIK")
      ->required()
      ->check(dialect_error)
      ->type_name("DIALECT");
  add_machine(command, convert.machine);
  add_curves(command, convert.machine);
  command.add_option("--out", convert.file, "File to write [renders/PROGRAM/PROGRAM.DIALECT.nc]")
      ->type_name("FILE");
  add_quiet(command, convert.verbosity);
}

namespace {

/// "I/N" as a shard: part I of N, counted from 0.
std::string take_shard(const std::string& text, BatchRunArguments& run) {
  std::size_t shard = 0;
  std::size_t shards = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard);
  const bool has_slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second =
      has_slash ? std::from_chars(first.ptr + 1, end, shards) : std::from_chars_result{end, {}};
  if (!has_slash || second.ec != std::errc() || second.ptr != end || shard >= shards) {
    return text + " is no shard; expected I/N with I from 0 to N - 1, as in 0/4";
  }
  run.shard = shard;
  run.shards = shards;
  return {};
}

void add_batch_run(CLI::App& command, BatchRunArguments& run) {
  command.add_option("--jobs", run.workers, "Runs at a time [as many as there are cores]")
      ->check(CLI::Range(1U, 1024U))
      ->type_name("J");
  add_quiet(command, run.verbosity);
}

}  // namespace

void add_options(CLI::App& command, BatchArguments& batch) {
  command.add_option("jobs", batch.jobs, "Jobs: JSON lines, a run each")
      ->required()
      ->type_name("JOBS.jsonl");
  command
      .add_option("--store", batch.run.store,
                  "Folder of the results; what it holds is not computed again")
      ->required()
      ->type_name("DIR");
  command
      .add_option("--shard", "Only every N-th job, from number I on: one part of N machines' work")
      ->check([&batch](const std::string& text) { return take_shard(text, batch.run); })
      ->type_name("I/N");
  add_batch_run(command, batch.run);
}

void add_options(CLI::App& command, SweepArguments& sweep) {
  command.add_option("sweep", sweep.sweep, "What is varied: a TOML file, see docs/manual.md")
      ->required()
      ->type_name("SWEEP.toml");
  command.add_flag("--list", sweep.is_listed_only,
                   "Write the jobs as JSON lines to standard output; run nothing");
  command.add_option("--store", sweep.run.store, "Folder of the results [OUT/store]")
      ->type_name("DIR");
  command.add_option("--out", sweep.folder, "Folder of table and page [renders/SWEEP]")
      ->type_name("DIR");
  add_batch_run(command, sweep.run);
}

void add_options(CLI::App& command, RigProbeArguments& probe) {
  add_machine(command, probe.machine);
  add_rig(command, probe.rig);
}

void add_options(CLI::App& command, RigMonitorArguments& monitor) {
  add_machine(command, monitor.machine);
  add_rig(command, monitor.rig);
  add_duration(command, monitor.duration);
}

void add_options(CLI::App& command, RigCheckArguments& check) {
  add_machine(command, check.machine);
  add_moving_rig(command, check.rig);
}

void add_options(CLI::App& command, RigJogArguments& jog) {
  add_axis(command, jog.axis);
  command.add_option("--distance-mm", jog.distance, "How far, signed")
      ->required()
      ->check(CLI::Range(-1e4, 1e4))
      ->type_name("D");
  add_feedrate(command, jog.feedrate, "Feedrate")->required();
  add_machine(command, jog.machine);
  add_moving_rig(command, jog.rig);
  add_last_results(command, jog.results, "Folder of the trace [renders/rig_jog]");
}

void add_options(CLI::App& command, RigHomeArguments& home) {
  add_axis(command, home.axis);
  add_machine(command, home.machine);
  add_moving_rig(command, home.rig);
  add_last_results(command, home.results, "Folder of the last move's trace [renders/rig_home]");
}

void add_options(CLI::App& command, RigEmulateArguments& emulate) {
  add_machine(command, emulate.machine);
  command.add_option("--rig-name", emulate.rig.name, "Shared memory [/twin-rig-UID]")
      ->type_name("/NAME");
  add_duration(command, emulate.duration);
  add_faults(command, emulate.rig.faults);
}

}  // namespace twin::cli
