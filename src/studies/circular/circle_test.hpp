#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <functional>
#include <string>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "pictures/figure/paper.hpp"
#include "results/trace/trace_files.hpp"
#include "session/machine.hpp"
#include "studies/circular/circle_program.hpp"
#include "studies/circular/circular_report.hpp"

namespace twin::studies::circular {

/// What a circular test runs.
struct CircleTest {
  config::MachineFile machine;
  std::string hal = "mujoco";         ///< name of the machine, for report and figure
  session::MakeMachine make_machine;  ///< makes one for each sense
  double radius = 20.0;               ///< of the circle about X0 Y0 [mm]
  double feedrate = 50.0;             ///< programmed [mm/s]
  std::string command{};              ///< command line of the caller, for the summaries
  results::TraceFiles trace = results::TraceFiles::kCsv;  ///< as which files traces are written
  std::filesystem::path folder;                           ///< of the results; made when missing
  pictures::Paper paper = pictures::Paper::kNone;         ///< whether the figure is a PDF as well
};

/// What a circular test has found.
struct CircleRun {
  Report report;
  std::array<MeasuredTurn, 2> turns;  ///< counter-clockwise, clockwise
};

/// Runs both senses, each on a machine of its own, and evaluates them. The folder gets the programs
/// circle_ccw.nc and circle_cw.nc, trace and summary of each sense, and circle.json.
///
/// @param progress  gets sense and done share, 0 to 1; may be empty
/// @param stop      set to brake and end
/// @returns what was found; a kUsage error where radius or feedrate are none for this machine; or
/// why a run failed
Expected<CircleRun> run_circle_test(const CircleTest& test,
                                    const std::function<void(Sense, double)>& progress,
                                    const std::atomic<bool>& stop);

/// Draws the polar figure of both senses into the folder.
Expected<void> draw_circle_test(const CircleTest& test, const CircleRun& run);

}  // namespace twin::studies::circular
