#pragma once

#include <optional>

#include "studies/identify/axis_problem.hpp"
#include "studies/identify/spectrum.hpp"

/// Estimates that need no search. The fit starts from them, near enough to its end.
namespace twin::studies::identify {

/// V-REF scale by regression of the way over the integral of the drive command [rpm/V]; nothing
/// where the command was not recorded.
std::optional<double> direct_scale(const AxisProblem& problem);

/// The part of the V-REF offset that a machine lacks, from the drift of y - x [V].
double direct_offset(const AxisProblem& problem, const config::MachineFile& machine);

/// Finds the hum on V-REF as the strongest tone of y - x, where x is simulated without hum. The
/// machine gets its amplitude, its frequency and its phase in the first record; the problem gets the
/// phases in the other records.
/// @returns false where no tone stands out; the amplitude is then 0
bool direct_hum(AxisProblem& problem, config::MachineFile& machine);

/// Searches the phase of the hum in each further record, relative to the first one. The machine is
/// the base of the problem.
void align_hum(AxisProblem& problem);

}  // namespace twin::studies::identify
