#pragma once

#include <memory>
#include <string>
#include <vector>

#include "twin/export.hpp"
#include "twin/machine.hpp"
#include "twin/settings.hpp"

namespace twin {

/// The simulated servo XY table of the settings' [table]: converters, drives, friction and encoders
/// by this library, masses by MuJoCo, which is loaded once a run configures it.
TWIN_EXPORT std::unique_ptr<Machine> make_table(const Settings& settings);

/// A machine whose position equals the set point: what remains of an error is the planner's own.
TWIN_EXPORT std::unique_ptr<Machine> make_ideal();

/// The rig's driver on emulated boards with the simulated table behind them, in simulated time. One
/// at a time in a process.
///
/// @param faults  what breaks and when, KIND[:AXIS]@SECONDS as --fault has it: "alarm:x@1.5"
/// @throws Failure for a fault that cannot be
TWIN_EXPORT std::unique_ptr<Machine> make_emulated_rig(const Settings& settings,
                                                       const std::vector<std::string>& faults = {});

}  // namespace twin
