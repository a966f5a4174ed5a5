#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "core/vec.hpp"
#include "gcode/program_text.hpp"
#include "hal/machine.hpp"
#include "motion/safety/trip.hpp"
#include "results/metrics/summary.hpp"
#include "runtime/motion.hpp"
#include "runtime/operator_panel.hpp"
#include "runtime/override_schedule.hpp"
#include "twin/trace.hpp"

namespace twin::runtime {

/// What a run does.
struct RunTask {
  gcode::ProgramText program;
  config::MachineFile machine;
  hal::Machine* hal = nullptr;     ///< unconfigured machine; null: plan only
  std::optional<double> feedrate;  ///< replaces the program's F words [mm/s]
};

/// Where the results of a run go.
struct RunOutput {
  std::filesystem::path directory;  ///< made when missing; empty: no file is written
  std::vector<TraceSink*> sinks;    ///< get the rows of the trace, besides the files
  std::string command;              ///< command line or the caller's own words, for the summary
};

/// How a run goes.
struct RunConduct {
  bool is_wall_clock = false;             ///< one period of the cycle per period of the wall clock
  std::vector<OverrideChange> overrides;  ///< of the feedrate, while it moves
  Until until;                            ///< ends the motion early, as at the path's end
};

/// Who takes part in a run. Null and empty: nobody.
struct RunListeners {
  const std::atomic<bool>* stop = nullptr;  ///< set to brake on the path and end
  std::function<void(double)> progress;     ///< gets the done share, 0 to 1
  std::function<void(double)> estimated;    ///< gets the cycle time before anything moves [s]
  OperatorPanel* panel = nullptr;           ///< for override and hold by an operator
};

/// What tests put between the parts of a run to make it go wrong. Empty functions do nothing.
struct TestHooks {
  /// In the motion thread, on the wall clock, after a period has begun; gets its number from 0.
  std::function<void(std::int64_t)> before_period;
  /// Where a segment has been planned for the motion; gets its number from 0.
  std::function<void(std::int64_t)> before_segment;
};

/// A run as it is asked for.
struct RunRequest : RunTask, RunOutput, RunConduct, RunListeners {
  TestHooks hooks;
};

/// How far a run got.
struct RunResult {
  results::Summary summary;
  /// Why the run ended early; what was recorded is kept, named as partial.
  std::optional<Error> failure;
  std::optional<motion::Trip> trip;  ///< where a monitor was the reason
  std::optional<Vec2> met_at;        ///< measured, where `until` came true [mm]
  Vec2 rest_at = Vec2::Zero();       ///< measured when the machine was switched off [mm]
};

/// Plans a program, moves the machine along it and records everything.
///
/// Before anything moves, the whole program is gone through, held against the travel, and planned
/// for the cycle time. The second pass is that of the run; its blocks go to planning and the
/// recorder. In lockstep without overrides a program is planned once: the run follows the first
/// plan, or, where that gets too long to be kept, the first pass goes on without planning.
/// The motion has a thread of its own, and the caller's thread is the recorder. On the wall clock
/// planning has a thread too; in lockstep it is done in the motion's. Whatever ends the motion, the
/// machine is off by then; what throws in a thread, progress() included, brakes it.
///
/// @returns what was recorded, or the error that kept the run from starting
Expected<RunResult> run_program(const RunRequest& request);

}  // namespace twin::runtime
