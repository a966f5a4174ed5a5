#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "motion/interpolator/set_point.hpp"

namespace twin::studies::identify {

/// The set points of a program, one per interpolation period, as a run has them.
///
/// They do not depend on the table, so one plan serves any number of simulations.
/// @param feedrate  replaces the F words [mm/s]
Expected<std::vector<motion::SetPoint>> plan_set_points(
    const std::filesystem::path& program, const config::MachineFile& machine,
    std::optional<double> feedrate = std::nullopt);

}  // namespace twin::studies::identify
