#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "cli/terminal.hpp"
#include "core/error.hpp"
#include "pictures/figure/paper.hpp"
#include "results/trace/trace_files.hpp"

/// What a command line says, as plain values: a struct for each command, in base units.
namespace twin::cli {

// Groups of options that several commands have.

/// The NC program, and what replaces its F words.
struct ProgramArguments {
  std::string name;                ///< a path, or a name in nc_programs
  std::optional<double> feedrate;  ///< --feedrate-mm-per-min [mm/s]
};

/// --machine, --set and --curves, and how programs are read.
struct MachineArguments {
  std::string file = "xy_table.toml";   ///< a path, or a name in mjcf
  std::vector<std::string> settings;    ///< section.key=value
  std::string curves;                   ///< "nurbs", "bezier", "linear"; empty: as the file has it
  bool has_old_name_of_curves = false;  ///< it was given as --interpolator
  std::string dialect;                  ///< --dialect; empty: as the file has it
  std::string ignored_axes;             ///< --ignore-axes; empty: as the file has it
  std::string offset_mm;                ///< --offset-mm: X,Y,Z; empty: of the machine file
  std::string tool_table;               ///< --tool-table; empty: of the machine file
  std::vector<std::filesystem::path> subprogram_folders;  ///< --subprograms
};

/// --hal rig: which rig it is, and what is known of it.
struct RigArguments {
  std::string which = "auto";        ///< "auto", "cards", "process", "emulated"
  std::string name;                  ///< of the emulator's shared memory; empty: the user's own
  std::filesystem::path log;         ///< gets the events at the emulated boards; empty: none
  std::vector<std::string> faults;   ///< of emulated boards: KIND[:AXIS]@SECONDS
  std::vector<std::string> changes;  ///< of the simulated table: KIND:AXIS=VALUE@SECONDS[+RAMP]
  bool is_known_to_move = false;     ///< --i-know-it-moves
};

/// --hal, and the rig that it may mean.
struct HalArguments {
  std::string name = "mujoco";  ///< "mujoco", "ideal", "rig"
  RigArguments rig;
};

/// Where results go, and what is said of them.
struct ResultArguments {
  std::filesystem::path folder;                           ///< --out; empty: one below renders
  bool has_plots = true;                                  ///< without --no-plots
  pictures::Paper paper = pictures::Paper::kNone;         ///< --pdf
  bool has_page = true;                                   ///< without --no-report
  results::TraceFiles trace = results::TraceFiles::kCsv;  ///< --trace, --no-trace
  bool has_json = false;  ///< --json: the summary goes to stdout as it is in the file
  std::string columns;    ///< --columns, of the trace; empty: the default ones
  Verbosity verbosity = Verbosity::kNormal;
};

/// --video and --camera.
struct VideoArguments {
  bool is_wanted = false;
  std::string camera = "iso";
};

// The commands.

/// --compensate and --learn.
struct CorrectionArguments {
  bool is_wanted = false;            ///< --compensate
  std::filesystem::path file;        ///< its FILE; empty: the correction is made now
  std::filesystem::path learning;    ///< --learn, a folder; empty: nothing is learnt
  std::vector<std::string> plant{};  ///< --set-plant: of the simulated table alone
};

/// --shadow.
struct ShadowArguments {
  bool is_wanted = false;
  std::filesystem::path file;  ///< of twin shadow --learn; empty: only the model is known
};

struct RunArguments {
  ProgramArguments program;
  MachineArguments machine;
  HalArguments hal;
  CorrectionArguments correction;
  ShadowArguments shadow;
  std::optional<double> tolerance;  ///< --tolerance-um, of the contour error [mm]
  std::string overrides;            ///< seconds:percent, ...
  bool is_on_wall_clock = false;    ///< --realtime
  std::filesystem::path control;    ///< socket for an operator; empty: none
  std::optional<int> view;          ///< --view, its port; 0: any
  std::string publish;              ///< --publish, an address; empty: none
  ResultArguments results;
  VideoArguments video;
};

struct PlanArguments {
  ProgramArguments program;
  MachineArguments machine;
  bool has_bound = false;  ///< the lower bound of the time as well
  std::string overrides;   ///< seconds:percent, ...
  ResultArguments results;
};

struct CheckArguments {
  std::vector<std::string> programs;
  std::optional<double> feedrate;  ///< [mm/s]
  MachineArguments machine;
  bool is_json = false;          ///< --json: one JSON document on stdout
  std::size_t most_errors = 20;  ///< --most-errors, of one program
  Verbosity verbosity = Verbosity::kNormal;
};

struct RenderArguments {
  std::filesystem::path folder;  ///< of an earlier run
  MachineArguments machine;
  bool has_plots = true;
  pictures::Paper paper = pictures::Paper::kNone;
  VideoArguments video;
  Verbosity verbosity = Verbosity::kNormal;
};

struct ReportArguments {
  std::vector<std::filesystem::path> folders;  ///< of runs
  std::filesystem::path file;                  ///< the page; empty: report.html
  Verbosity verbosity = Verbosity::kNormal;
};

struct SettingsArguments {
  std::string filter;  ///< part of a section's or key's name; empty: all
  MachineArguments machine;
};

struct CompareArguments {
  std::vector<std::string> programs;
  std::optional<double> feedrate;  ///< [mm/s]
  MachineArguments machine;
  std::string hal = "mujoco";  ///< "mujoco", "ideal"
  std::string with;            ///< "linuxcnc": another controller; empty: our own planners
  ResultArguments results;
};

struct ReproduceArguments {
  MachineArguments machine;
  int repeats = 10;  ///< of the runs, with other phases
  ResultArguments results;
};

struct CircleArguments {
  double radius = 20.0;            ///< [mm]
  std::optional<double> feedrate;  ///< [mm/s]
  MachineArguments machine;
  HalArguments hal;
  ResultArguments results;
};

struct IdentifyArguments {
  std::vector<std::string> traces;      ///< CSV files
  std::vector<std::string> at_table;    ///< CSV files of an encoder at the table
  std::vector<std::string> validating;  ///< CSV files that are predicted only
  bool has_tables = false;              ///< the published tables take the place of traces
  MachineArguments machine;
  std::string columns;                     ///< SIGNAL=COLUMN[:UNIT],...
  std::filesystem::path file;              ///< machine file to write; empty: one below renders
  std::vector<std::string> fixed;          ///< keys that keep the machine file's value
  std::vector<std::string> freed;          ///< keys that are fitted though they would be held
  std::uint32_t seed = 1;                  ///< of the global search
  std::optional<std::size_t> evaluations;  ///< simulations of the global search
  bool has_plots = true;                   ///< of the predictions
  Verbosity verbosity = Verbosity::kNormal;
};

struct CompensateArguments {
  ProgramArguments program;
  MachineArguments machine;
  std::filesystem::path file;  ///< to write; empty: renders/PROGRAM/correction.csv
  Verbosity verbosity = Verbosity::kNormal;
};

struct ShadowCommandArguments {
  std::vector<std::string> traces;
  bool is_learning = false;      ///< --learn
  std::filesystem::path learnt;  ///< --learnt, what an earlier --learn has written; may be empty
  std::filesystem::path file;    ///< --out; empty: beside the trace, or one below renders
  std::string columns;           ///< SIGNAL=COLUMN[:UNIT],...
  MachineArguments machine;
  Verbosity verbosity = Verbosity::kNormal;
};

struct FastestArguments {
  std::string program;
  MachineArguments machine;
  double tolerance = 0.0;      ///< --tolerance-um, always given [mm]
  std::filesystem::path file;  ///< program to write; empty: renders/PROGRAM/fastest.nc
  Verbosity verbosity = Verbosity::kNormal;
};

struct ConvertArguments {
  ProgramArguments program;
  std::string dialect;
  MachineArguments machine;
  std::filesystem::path file;  ///< to write; empty: one below renders
  Verbosity verbosity = Verbosity::kNormal;
};

/// How many runs go on, and where their results are kept.
struct BatchRunArguments {
  std::filesystem::path store;  ///< --store
  unsigned workers = 0;         ///< --jobs; 0: as many as there are cores
  std::size_t shard = 0;        ///< --shard I/N
  std::size_t shards = 1;
  Verbosity verbosity = Verbosity::kNormal;
};

struct BatchArguments {
  std::filesystem::path jobs;  ///< JSON lines
  BatchRunArguments run;
};

struct SweepArguments {
  std::filesystem::path sweep;   ///< TOML
  std::filesystem::path folder;  ///< --out; empty: one below renders
  bool is_listed_only = false;   ///< --list: the jobs go to standard output, nothing is run
  BatchRunArguments run;
};

struct TuneArguments {
  std::vector<std::string> programs;
  std::optional<double> feedrate;  ///< [mm/s]
  MachineArguments machine;
  std::string aim = "error";            ///< --for: "error", "time"
  std::optional<double> largest_error;  ///< --within-um [um]
  double gain_margin = 6.0;             ///< --gain-margin-dB [dB]
  double phase_margin = 30.0;           ///< --phase-margin-deg [deg]
  std::vector<std::string> ranges;      ///< --vary KEY=FROM:TO[:log]; empty: the usual ones
  std::vector<std::string> further;     ///< --also, programs that are judged and not tuned on
  std::size_t trials = 2000;            ///< --trials
  std::uint32_t seed = 1;               ///< --seed
  std::filesystem::path folder;         ///< --out; empty: one below renders
  BatchRunArguments run;
};

struct RigProbeArguments {
  MachineArguments machine;
  RigArguments rig;
};

struct RigMonitorArguments {
  MachineArguments machine;
  RigArguments rig;
  std::optional<double> duration;  ///< [s]; without it to the end of time
};

struct RigCheckArguments {
  MachineArguments machine;
  RigArguments rig;
};

struct RigJogArguments {
  std::string axis;                ///< "x", "y"
  double distance = 0.0;           ///< signed [mm]
  std::optional<double> feedrate;  ///< always given [mm/s]
  MachineArguments machine;
  RigArguments rig;
  ResultArguments results;
};

struct RigHomeArguments {
  std::string axis;  ///< "x", "y"
  MachineArguments machine;
  RigArguments rig;
  ResultArguments results;
};

struct RigEmulateArguments {
  MachineArguments machine;
  RigArguments rig;                ///< name and faults alone
  std::optional<double> duration;  ///< [s]; without it until it is stopped
};

struct PlantArguments {
  MachineArguments machine;
  std::string program;  ///< that LinuxCNC runs; empty: recordings are not held against one
  std::string name;     ///< of the shared memory; empty: the user's own
  std::vector<std::string> faults;   ///< KIND:AXIS@SECONDS
  std::vector<std::string> changes;  ///< KIND:AXIS=VALUE@SECONDS[+RAMP]
  std::optional<double> duration;    ///< of simulated time [s]; without it until it is stopped
  std::filesystem::path folder;      ///< of the recordings; empty: renders/plant
  bool has_recording = true;         ///< without --no-trace
};

struct LinuxcncConfigArguments {
  MachineArguments machine;
  std::filesystem::path folder;  ///< empty: renders/linuxcnc
};

struct LinuxcncEvaluateArguments {
  std::filesystem::path folder;  ///< of a recording
  std::string program;           ///< that LinuxCNC ran
  MachineArguments machine;
  bool has_plots = true;  ///< without --no-plots
};

/// --help or --version: the text that is asked for.
struct TextArguments {
  std::string text;
};

/// What a command line asks for.
using Arguments =
    std::variant<TextArguments, RunArguments, PlanArguments, CheckArguments, RenderArguments,
                 ReportArguments, SettingsArguments, CompareArguments, ReproduceArguments,
                 CircleArguments, IdentifyArguments, CompensateArguments, ShadowCommandArguments,
                 FastestArguments, ConvertArguments, BatchArguments, SweepArguments, TuneArguments,
                 RigProbeArguments, RigMonitorArguments, RigCheckArguments, RigJogArguments,
                 RigHomeArguments, RigEmulateArguments, PlantArguments, LinuxcncConfigArguments,
                 LinuxcncEvaluateArguments>;

/// Reads a command line.
///
/// @param words  the command line without the program's name
/// @returns what it asks for; or a kUsage error, one line that names the nearest command or option
Expected<Arguments> parse_arguments(std::span<const char* const> words);

}  // namespace twin::cli
