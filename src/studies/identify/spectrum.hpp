#pragma once

#include <complex>
#include <optional>
#include <span>

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

}  // namespace twin::studies::identify
