#pragma once

#include <optional>

#include "studies/identify/axis_problem.hpp"
#include "studies/identify/spectrum.hpp"

/// Estimates that need no search; they begin the fit where it cannot miss.
namespace twin::studies::identify {

/// V-REF scale by regression of the way over the integral of the drive command [rpm/V]; nothing
/// where the command was not recorded.
std::optional<double> direct_scale(const AxisProblem& problem);

/// What of the V-REF offset is missing in a machine, by the drift of y - x [V].
double direct_offset(const AxisProblem& problem, const config::MachineFile& machine);

/// Hum on V-REF, by the strongest tone of y - x, x simulated without hum. Writes amplitude,
/// frequency and phase of the first record into the machine and the other records' phases into the
/// problem. @returns false where no tone stands out; the amplitude is then 0
bool direct_hum(AxisProblem& problem, config::MachineFile& machine);

/// Searches each further record's phase of the hum against the first, the machine being the
/// problem's base.
void align_hum(AxisProblem& problem);

}  // namespace twin::studies::identify
