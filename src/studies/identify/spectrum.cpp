#include "studies/identify/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace twin::studies::identify {
namespace {

constexpr double kStandsOut = 8.0;  // times the median amplitude
constexpr double kPi = std::numbers::pi;

/// Windowed Fourier coefficient at a frequency, scaled so that a tone gives a exp(i phi) / i.
std::complex<double> coefficient(std::span<const double> signal, double period, double frequency) {
  const auto n = static_cast<double>(signal.size());
  const std::complex<double> turn = std::polar(1.0, -2.0 * kPi * frequency * period);
  const std::complex<double> window_turn = std::polar(1.0, 2.0 * kPi / n);
  std::complex<double> rotation = 1.0;
  std::complex<double> window = window_turn;
  std::complex<double> sum = 0.0;
  double weight = 0.0;
  for (const double value : signal) {
    const double w = 0.5 - 0.5 * window.real();
    sum += w * value * rotation;
    weight += w;
    rotation *= turn;
    window *= window_turn;
  }
  return 2.0 * sum / weight;
}

double amplitude(std::span<const double> signal, double period, double frequency) {
  return std::abs(coefficient(signal, period, frequency));
}

}  // namespace

Tone tone_at(std::span<const double> signal, double period, double frequency) {
  const std::complex<double> c = coefficient(signal, period, frequency);
  // a sin(wt + phi) has the coefficient a exp(i (phi - pi / 2)).
  return {frequency, std::abs(c), std::remainder(std::arg(c) + kPi / 2.0, 2.0 * kPi)};
}

std::optional<Tone> strongest_tone(std::span<const double> signal, double period, double lowest,
                                   double highest) {
  const double step = 0.5 / (static_cast<double>(signal.size()) * period);
  std::vector<double> amplitudes;
  for (double f = lowest; f <= highest; f += step) {
    amplitudes.push_back(amplitude(signal, period, f));
  }
  if (amplitudes.size() < 10) {
    return std::nullopt;
  }
  const auto peak = std::ranges::max_element(amplitudes);
  const double high = *peak;
  double low_end = lowest + step * static_cast<double>(peak - amplitudes.begin() - 1);
  double high_end = low_end + 2.0 * step;
  std::vector<double> sorted = amplitudes;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  if (high < kStandsOut * *middle) {
    return std::nullopt;
  }
  for (int i = 0; i < 40; ++i) {  // by thirds: the peak of the window's spectrum has one maximum
    const double a = low_end + (high_end - low_end) / 3.0;
    const double b = high_end - (high_end - low_end) / 3.0;
    (amplitude(signal, period, a) < amplitude(signal, period, b) ? low_end : high_end) =
        amplitude(signal, period, a) < amplitude(signal, period, b) ? a : b;
  }
  return tone_at(signal, period, 0.5 * (low_end + high_end));
}

}  // namespace twin::studies::identify
