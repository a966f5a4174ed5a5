#include "cli/options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <system_error>

#include "cli/option_groups.hpp"

namespace twin::cli {

void add_options(CLI::App& command, RunArguments& run) {
  command.footer(
      "Examples:\n"
      "  twin run dolphin.nc\n"
      "  twin run part.nc --set servo.x.kp_per_s=250 --out soft\n"
      "  twin run part.nc --no-trace --json\n"
      "  twin run dolphin.nc --hal rig --rig emulated --fault alarm:x@1.5");
  add_program(command, run.program);
  begin_group(command, "Machine");
  add_machine(command, run.machine);
  add_reading(command, run.machine);
  add_curves(command, run.machine);
  add_hal(command, run.hal);
  begin_group(command, "Correction");
  add_correction(command, run.correction);
  add_tolerance(command, "--tolerance-um",
                "Say before the run with what probability the contour error stays within this",
                [&run](double tolerance) { run.tolerance = tolerance; });
  begin_group(command, "While it runs");
  add_shadow(command, run.shadow);
  add_overrides(command, run.overrides);
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
  command
      .add_option_function<int>(
          "--view", [&run](int port) { run.view = port; },
          "On the wall clock: serve the page of the run while it goes on, at an address that is "
          "printed; of this computer alone, at a port or any (0)")
      ->check(CLI::Range(0, 65535))
      ->type_name("PORT");
  command
      .add_option("--publish", run.publish,
                  "Send the rows as they come, as JSON that PlotJuggler shows, as in "
                  "udp://127.0.0.1:9870")
      ->type_name("ADDRESS");
  begin_group(command, "Results");
  add_run_results(command, run.results);
  add_video(command, run.video);
}

void add_options(CLI::App& command, PlanArguments& plan) {
  add_program(command, plan.program);
  add_machine(command, plan.machine);
  add_reading(command, plan.machine);
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
  add_reading(command, check.machine);
  command.add_flag("--json", check.is_json, "Write what is found as one JSON document on stdout");
  command.add_option("--most-errors", check.most_errors, "Errors of a program that are shown")
      ->check(CLI::Range(1, 100000))
      ->type_name("N")
      ->capture_default_str();
  add_quiet(command, check.verbosity);
}

void add_options(CLI::App& command, RenderArguments& render) {
  command.add_option("directory", render.folder, "Folder of an earlier run")
      ->required()
      ->type_name("DIR");
  add_machine_file(command, render.machine, "Machine file whose model the video shows");
  add_no_plots(command, render.has_plots);
  add_paper(command, render.paper);
  add_quiet(command, render.verbosity);
  add_video(command, render.video);
}

void add_options(CLI::App& command, ReportArguments& report) {
  command.footer(
      "Examples:\n"
      "  twin report renders/dolphin\n"
      "  twin report soft stiff --out both.html");
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

void add_options(CLI::App& command, SettingsArguments& settings) {
  command.footer(
      "Examples:\n"
      "  twin settings\n"
      "  twin settings limits --machine my.toml\n"
      "  twin settings servo --set servo.x.kp_per_s=400");
  command
      .add_option("filter", settings.filter,
                  "Only settings with this in their name, as in limits or servo.x")
      ->type_name("TEXT");
  add_machine(command, settings.machine);
}

void add_options(CLI::App& command, CompareArguments& compare) {
  command.footer(
      "A setting that is given several times is varied: a run each, and a page of all.\n"
      "Examples:\n"
      "  twin compare dolphin.nc\n"
      "  twin compare --set servo.x.kp=200 --set servo.x.kp=300 dolphin.nc\n"
      "  twin compare renders/soft renders/stiff\n"
      "  twin compare --with linuxcnc dolphin.nc gear.nc");
  command
      .add_option("program", compare.programs,
                  "NC programs: files, or names of some in nc_programs; more than one are planned "
                  "only, a line each program and planner. Or folders of runs: a page of them")
      ->required()
      ->type_name("PROGRAM.nc");
  add_feedrate(command, compare.feedrate);
  add_machine(command, compare.machine);
  add_reading(command, compare.machine);
  add_simulated_hal(command, compare.hal);
  command
      .add_option(
          "--with", compare.with,
          "Another controller on the same table: linuxcnc runs LinuxCNC, headless, with its "
          "own pid at the gains of the machine file")
      ->check(CLI::IsMember({"linuxcnc"}))
      ->type_name("NAME");
  add_results(command, compare.results, "PROGRAM_compare");
  add_trace(command, compare.results);
}

void add_options(CLI::App& command, ReproduceArguments& reproduce) {
  add_machine(command, reproduce.machine);
  command
      .add_option("--repeats", reproduce.repeats, "Runs a row with other encoder and hum phases")
      ->check(CLI::Range(0, 1000))
      ->type_name("N")
      ->capture_default_str();
  add_results(command, reproduce.results, "reproduce");
  add_trace(command, reproduce.results);
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
  add_paper(command, circle.results.paper);
  add_trace(command, circle.results);
}

void add_options(CLI::App& command, ConvertArguments& convert) {
  add_program(command, convert.program);
  command
      .add_option("--to", convert.dialect,
                  "g5.2: LinuxCNC; g6.2: LinuxCNC 2.10; fanuc: G06.2; bspline: SINUMERIK")
      ->required()
      ->type_name("DIALECT");
  add_machine(command, convert.machine);
  add_reading(command, convert.machine);
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

void add_options(CLI::App& command, TuneArguments& tune) {
  command.footer(
      "Examples:\n"
      "  twin tune dolphin.nc oxalis.nc --also square.nc\n"
      "  twin tune part.nc --for time --within-um 50\n"
      "  twin tune part.nc --vary servo.x.kp_per_s=100:500:log --trials 200");
  command.add_option("programs", tune.programs, "NC programs: files, or names in nc_programs")
      ->required()
      ->type_name("PROGRAM.nc ...");
  add_feedrate(command, tune.feedrate);
  add_machine(command, tune.machine);
  begin_group(command, "Aim");
  command
      .add_option("--for", tune.aim,
                  "error: least contour error of any program; time: least machining time of all "
                  "within --within-um")
      ->check(CLI::IsMember({"error", "time"}))
      ->type_name("AIM")
      ->capture_default_str();
  command
      .add_option("--within-um", tune.largest_error,
                  "Contour error to keep with --for time [that of the machine file's settings]")
      ->check(CLI::Range(1e-3, 1e6))
      ->type_name("E");
  command
      .add_option("--gain-margin-dB", tune.gain_margin, "Least gain margin of both position loops")
      ->check(CLI::Range(0.0, 60.0))
      ->type_name("M")
      ->capture_default_str();
  command.add_option("--phase-margin-deg", tune.phase_margin, "Least phase margin of both")
      ->check(CLI::Range(0.0, 90.0))
      ->type_name("P")
      ->capture_default_str();
  begin_group(command, "Search");
  add_list(command, "--vary", tune.ranges,
           "Setting to tune, and its range, as in servo.x.kp_per_s=100:500:log (repeatable) [gains "
           "and feedforwards of both axes; with --for time jerk and tolerances as well]")
      ->type_name("KEY=FROM:TO[:log]");
  add_list(command, "--also", tune.further,
           "Program that is shown before and after, and not tuned on (repeatable)")
      ->type_name("PROGRAM.nc");
  command.add_option("--trials", tune.trials, "Combinations of settings at most")
      ->check(CLI::Range(1, 10000000))
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--seed", tune.seed, "Of the search; same seed, same result")
      ->capture_default_str();
  begin_group(command, "Results");
  command
      .add_option("--store", tune.run.store,
                  "Folder of the results of runs; what it holds is not computed again [OUT/store]")
      ->type_name("DIR");
  command
      .add_option("--out", tune.folder,
                  "Folder of machine file, table and page [renders/PROGRAM_tune]")
      ->type_name("DIR");
  add_batch_run(command, tune.run);
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
  add_trace(command, jog.results, true);
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
  add_changes(command, emulate.rig.changes);
}

}  // namespace twin::cli
