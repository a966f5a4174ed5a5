#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/machine.hpp"

namespace twin::studies::commissioning {

/// Homing of one axis.
struct HomeRun {
  hal::Axis axis = hal::kX;
  config::MachineFile machine;
  std::filesystem::path folder;  ///< gets the last move's trace; empty: renders/rig_home
  std::string command{};         ///< command line of the caller, for the summary
};

/// Homes an axis with a machine: makes the moves of home_axis() in closed loop, one after the
/// other, each with trace and summary. Nobody knows where the table stands, so the limit switches
/// are the only limits of travel.
///
/// @param hal   unconfigured machine
/// @param tell  gets a line before each move, as in "axis x: towards P-OT"
/// @param stop  set to brake and end
Expected<void> run_homing(const HomeRun& run, hal::Machine& hal,
                          const std::function<void(const std::string&)>& tell,
                          const std::atomic<bool>& stop);

}  // namespace twin::studies::commissioning
