#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "core/vec.hpp"
#include "hal/machine.hpp"
#include "motion/safety/trip.hpp"
#include "results/metrics/summary.hpp"
#include "runtime/hooks.hpp"
#include "runtime/operator_panel.hpp"
#include "runtime/override_schedule.hpp"

namespace twin::runtime {

/// What to run.
struct RunRequest {
  std::filesystem::path program;  ///< NC program
  config::MachineFile machine;
  hal::Machine* hal = nullptr;      ///< unconfigured machine; null: plan only
  std::optional<double> feedrate;   ///< replaces the program's F words [mm/s]
  std::filesystem::path directory;  ///< of the results; made when missing
  bool is_wall_clock = false;       ///< one period of the cycle per period of the wall clock
  const std::atomic<bool>* stop = nullptr;  ///< set to brake on the path and end
  std::function<void(double)> progress;     ///< gets the done share, 0 to 1
  std::function<void(double)> estimated;    ///< gets the cycle time before anything moves [s]
  std::vector<OverrideChange> overrides;    ///< of the feedrate, while it moves
  OperatorPanel* panel = nullptr;           ///< for override and hold by an operator
  Until until;                              ///< ends the motion early, as at the path's end
  Hooks hooks;                              ///< for tests
  std::string command;             ///< command line or other words of the caller, for the summary
  std::vector<std::string> notes;  ///< what the caller changed of what was asked for, the same
};

/// How far a run got.
struct RunResult {
  results::Summary summary;
  std::optional<Error>
      failure;  ///< why it ended early; what was recorded is kept, named as partial
  std::optional<motion::Trip> trip;  ///< where a monitor was the reason
  std::optional<Vec2> met_at;        ///< measured, where `until` came true [mm]
  Vec2 rest_at = Vec2::Zero();       ///< measured when the machine was switched off [mm]
};

/// Plans a program, moves the machine along it and records everything: planning thread, motion
/// thread, and the caller's as recorder.
///
/// Before anything moves the whole program is read and held against the travel, and planned for the
/// cycle time. Whatever ends the
/// motion, the machine is off by then; what throws in a thread, progress() included, brakes it.
///
/// @returns what was recorded, or the error that kept the run from starting
Expected<RunResult> run_program(const RunRequest& request);

}  // namespace twin::runtime
