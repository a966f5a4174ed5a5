#pragma once

#include <atomic>
#include <string>

#include "cli/options.hpp"
#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/machine.hpp"
#include "runtime/run.hpp"

/// Closed-loop moves of one axis, made as a program would be: same planner, loops and monitors.
namespace twin::cli {

/// One straight move of an axis from where it stands.
struct AxisMove {
  std::string name;       ///< of its files, as in "jog"
  char axis = 'x';        ///< x or y
  double distance = 0.0;  ///< signed [mm]
  double feedrate = 0.0;  ///< [mm/s]
  runtime::Until until;   ///< ends it early; empty: nothing does
};

/// Makes the move and leaves program, trace and summary in the folder of the results.
///
/// @returns what was recorded, which may be a failure; an error where the move could not be begun
Expected<runtime::RunResult> make_axis_move(const AxisMove& move, const Options& options,
                                            const config::MachineFile& machine, hal::Machine& hal,
                                            const std::atomic<bool>& stop);

}  // namespace twin::cli
