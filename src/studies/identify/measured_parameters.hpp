#pragma once

#include <string>
#include <vector>

#include "studies/identify/axis_fit.hpp"

namespace twin::studies::identify {

/// Reads the encoder's count off the first record. Where the record shows it, the machine gets it.
FittedParameter measure_count(const AxisProblem& problem, const FitOptions& options,
                              config::MachineFile& machine);

/// Fits the servo's gains to the recorded drive commands. The machine gets those that the commands
/// show.
///
/// @returns a parameter for each gain; none where the drive commands were not recorded
std::vector<FittedParameter> measure_gains(const AxisProblem& problem, const FitOptions& options,
                                           config::MachineFile& machine);

}  // namespace twin::studies::identify
