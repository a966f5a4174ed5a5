#pragma once

#include <memory>

#include "twin/export.hpp"
#include "twin/machine.hpp"
#include "twin/settings.hpp"

namespace twin {

/// The simulated servo XY table of the settings' [table]: converters, drives, friction and encoders
/// by this library, masses by MuJoCo, which is loaded once a run configures it.
TWIN_EXPORT std::unique_ptr<Machine> make_table(const Settings& settings);

/// A machine whose position equals the set point: what remains of an error is the planner's own.
TWIN_EXPORT std::unique_ptr<Machine> make_ideal();

}  // namespace twin
