#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/machine.hpp"
#include "runtime/run.hpp"
#include "session/session.hpp"

namespace twin::session {

/// One straight move of an axis from where it stands, in closed loop. It is made as a program would
/// be: by the same planner, loops and monitors.
struct AxisMove {
  std::string name;              ///< of its files, as in "jog"
  hal::Axis axis = hal::kX;      ///< the axis that moves
  double distance = 0.0;         ///< signed [mm]
  double feedrate = 0.0;         ///< [mm/s]
  std::filesystem::path folder;  ///< of its results; empty: renders/rig_NAME
  std::string command{};         ///< command line of the caller, for the summary
  runtime::Until until{};        ///< ends it early; empty: nothing does
  results::TraceFiles trace = results::TraceFiles::kCsv;  ///< as which files its trace is written
};

/// Makes the move and leaves program, trace and summary in the folder of the results.
///
/// @param hal   unconfigured machine
/// @param stop  set to brake and end
/// @returns what was recorded, which may be a failure; an error where the move could not be begun
Expected<runtime::RunResult> make_axis_move(const AxisMove& move,
                                            const config::MachineFile& machine, hal::Machine& hal,
                                            const std::atomic<bool>& stop);

}  // namespace twin::session
