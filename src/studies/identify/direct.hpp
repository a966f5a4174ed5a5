#pragma once

#include <optional>
#include <span>

#include "studies/identify/axis_problem.hpp"

/// Estimates that need no search. The fit starts from them, near enough to its end.
namespace twin::studies::identify {

/// The tone a sin(2 pi f t + phi), t = k T.
struct Tone {
  double frequency = 0.0;  ///< f [Hz]
  double amplitude = 0.0;  ///< a, in the signal's unit
  double phase = 0.0;      ///< phi [rad]
};

/// Best fit of a tone of a given frequency, with a Hann window against what leaks from others.
/// @param period  T [s]
Tone tone_at(std::span<const double> signal, double period, double frequency);

/// The strongest tone within a range of frequencies, if it stands out.
///
/// Searched on a grid of half the resolution 1 / (N T), refined to the peak of the windowed
/// spectrum. It stands out when its amplitude is several times the median over the range.
std::optional<Tone> strongest_tone(std::span<const double> signal, double period, double lowest,
                                   double highest);

/// V-REF scale by regression of the way over the integral of the drive command [rpm/V]; nothing
/// where the command was not recorded.
std::optional<double> direct_scale(const AxisProblem& problem);

/// The part of the V-REF offset that a machine lacks, from the drift of y - x [V].
double direct_offset(const AxisProblem& problem, const config::MachineFile& machine);

/// Whether a tone stands out in the records.
enum class Hum { kFound, kNone };

/// Finds the hum on V-REF as the strongest tone of y - x, where x is simulated without hum. The
/// machine gets its amplitude, its frequency and its phase in the first record; the problem gets the
/// phases in the other records.
/// @returns kNone where no tone stands out; the amplitude is then 0
Hum direct_hum(AxisProblem& problem, config::MachineFile& machine);

/// Searches the phase of the hum in each further record, relative to the first one. The machine is
/// the base of the problem.
void align_hum(AxisProblem& problem);

}  // namespace twin::studies::identify
