#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/vec.hpp"
#include "gcode/notes.hpp"
#include "gcode/program_text.hpp"
#include "hal/machine.hpp"
#include "motion/safety/trip.hpp"
#include "results/metrics/summary.hpp"
#include "results/trace/columns.hpp"
#include "results/trace/trace_files.hpp"
#include "runtime/motion.hpp"
#include "runtime/operator_panel.hpp"
#include "runtime/override_schedule.hpp"
#include "twin/servo.hpp"
#include "twin/trace.hpp"

namespace twin::runtime {

/// What is run: a program on a machine.
struct RunTask {
  gcode::ProgramText program;
  config::MachineFile machine;
  hal::Machine* hal = nullptr;     ///< unconfigured machine; null: compute set points only
  Servo* servo = nullptr;          ///< position loops in place of the machine file's; may be null
  std::optional<double> feedrate;  ///< replaces the program's F words [mm/s]
};

/// Where the results of a run go.
struct RunOutput {
  std::filesystem::path directory;  ///< made when missing; empty: no file is written
  results::TraceFiles trace = results::TraceFiles::kCsv;  ///< as which files the trace is written
  std::vector<TraceSink*> sinks;                ///< get the rows of the trace, besides the files
  results::ColumnChoice columns;                ///< of the trace; empty: the default ones
  Durability durability = Durability::kSynced;  ///< of the trace
  std::string command;  ///< command line or the caller's own words, for the summary
};

/// How the motion is carried out.
struct RunConduct {
  bool is_wall_clock = false;             ///< each period takes one period of the wall clock
  std::vector<OverrideChange> overrides;  ///< feed override at given times of the motion
  Until until;                            ///< ends the motion early, like the end of the path
};

/// Whoever watches or operates the run. Members that are null or empty are not used.
struct RunListeners {
  const std::atomic<bool>* stop = nullptr;  ///< set to brake on the path and end
  std::function<void(double)> progress;     ///< gets the done share, 0 to 1
  std::function<void(double)> estimated;    ///< gets the machining time before anything moves [s]
  /// Gets the notes on the program before anything moves, if there are any.
  std::function<void(const std::vector<gcode::Note>&)> noted;
  OperatorPanel* panel = nullptr;  ///< for override and hold by an operator
};

/// Functions by which tests disturb a run, for instance to delay a thread. Empty ones do nothing.
struct TestHooks {
  /// Called in the motion thread, on the wall clock, after a period has begun, with its number from
  /// 0.
  std::function<void(std::int64_t)> before_period;
  /// Called before a segment is handed to the motion, with its number from 0.
  std::function<void(std::int64_t)> before_segment;
};

/// Everything that describes a run.
struct RunRequest : RunTask, RunOutput, RunConduct, RunListeners {
  TestHooks hooks;
};

/// What a run has recorded, and how it ended.
struct RunResult {
  results::Summary summary;
  /// Why the run ended early. The trace until then is kept in trace.partial.csv, or as HDF5.
  std::optional<Error> failure;
  std::optional<motion::Trip> trip;  ///< the monitor's finding, if a monitor ended the run
  std::optional<Vec2> met_at;        ///< measured position where `until` came true [mm]
  Vec2 rest_at = Vec2::Zero();       ///< measured position when the machine was switched off [mm]
};

/// Plans a program, moves the machine along it and records everything.
///
/// Before anything moves, the whole program is gone through, checked against the travel, and planned
/// for the estimate of the cycle time. The run then goes through the program a second time and gives
/// its blocks to planning and to the recorder. In lockstep without overrides a program is planned
/// only once: the run follows the plan of the estimate. Where that plan gets too long to be kept,
/// the first pass goes on without planning.
///
///   thread        | on the wall clock       | in lockstep
///   --------------+-------------------------+-------------------------
///   the caller's  | recorder                | recorder
///   motion        | cycle                   | cycle and planning
///   planning      | planning                |
///
/// However the motion ends, the machine is off afterwards. An exception in any thread, also one
/// from progress(), brakes the machine on the path and ends the run.
///
/// @returns what was recorded, or the error that kept the run from starting
Expected<RunResult> run_program(const RunRequest& request);

}  // namespace twin::runtime
