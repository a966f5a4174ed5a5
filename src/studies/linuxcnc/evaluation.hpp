#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "results/metrics/summary.hpp"

namespace twin::studies::linuxcnc {

/// What a recording is held against.
struct EvaluationRequest {
  std::filesystem::path folder;  ///< of the recording; gets the results
  gcode::ProgramText program;    ///< that LinuxCNC ran
  config::MachineFile machine;   ///< of the plant
  std::string command{};         ///< command line, for the summary
};

/// Holds a recording against the program that LinuxCNC ran: contour error of set points, encoders
/// and table, peaks of the set points by their differences.
///
/// The recording is taken from the last row before the set point begins to move to the first one
/// where it stands for good. trace.csv of the folder gets the columns of a run, and summary.json is
/// written beside it, so that report, plots and identification take the folder as that of a run.
/// @returns the summary; an error where the recording does not follow the program
Expected<results::Summary> evaluate(const EvaluationRequest& request);

}  // namespace twin::studies::linuxcnc
