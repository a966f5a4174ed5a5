#include "studies/identify/direct.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "core/parallel_for.hpp"

namespace twin::studies::identify {
namespace {

constexpr double kScaleWindow = 0.05;       // over which ways are compared [s]
constexpr double kLowestHum = 15.0;         // [Hz]
constexpr double kHighestHum = 420.0;       // [Hz]
constexpr double kNyquistShare = 0.45;      // of the sampling rate that is looked at
constexpr std::size_t kSearchRows = 16384;  // rows that the search for a tone looks at
constexpr std::size_t kPhases = 12;         // that a search for a phase tries in a turn
constexpr double kPhaseTolerance = 2e-3;    // [rad]
constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Least-squares line through evenly spaced values: takes it off, returns its slope per row.
double take_line(Eigen::VectorXd& values) {
  const auto n = static_cast<double>(values.size());
  const Eigen::VectorXd x =
      Eigen::VectorXd::LinSpaced(values.size(), -(n - 1.0) / 2.0, (n - 1.0) / 2.0);
  const double slope = x.dot(values) / x.squaredNorm();
  values -= slope * x;
  values.array() -= values.mean();
  return slope;
}

std::span<const double> view(const Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

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

std::optional<double> direct_scale(const AxisProblem& problem) {
  const config::MachineFile& machine = problem.base();
  const auto window = static_cast<std::size_t>(std::lround(kScaleWindow / machine.period));
  double over = 0.0;
  double under = 0.0;
  for (const AxisRecord& record : problem.records()) {
    if (!record.has_volts()) {
      return std::nullopt;
    }
    for (std::size_t k = 0; k + window < record.volts.size(); k += window) {
      double way = 0.0;  // that 1 mm/s/V would make [mm/(mm/s/V)]
      for (std::size_t i = k; i < k + window; ++i) {
        way += record.volts[i] * machine.period;
      }
      over += way * (record.measured[k + window] - record.measured[k]);
      under += way * way;
    }
  }
  if (!(under > 0.0) || over == 0.0) {
    return std::nullopt;
  }
  const double lead = machine.table.axis[problem.axis()].screw.lead;
  return over / under / lead * 60.0;
}

double direct_offset(const AxisProblem& problem, const config::MachineFile& machine) {
  double rate = 0.0;
  double weight = 0.0;
  for (std::size_t i = 0; i < problem.records().size(); ++i) {
    Eigen::VectorXd values = problem.difference(machine, i);
    const auto rows = static_cast<double>(values.size());
    rate += rows * take_line(values) / machine.period;
    weight += rows;
  }
  return rate / weight / machine.table.axis[problem.axis()].mm_per_s_per_volt();
}

Hum direct_hum(AxisProblem& problem, config::MachineFile& machine) {
  hal::mujoco::DriveParams& drive = machine.table.axis[problem.axis()].drive;
  drive.hum_amplitude = 0.0;
  const double highest = std::min(kHighestHum, kNyquistShare / machine.period);
  const double scale = machine.table.axis[problem.axis()].mm_per_s_per_volt();
  // Row 0 is read after the time of holding still and one period more.
  const double start = (std::round(kSettleTime / machine.period) + 1.0) * machine.period;
  std::optional<Tone> first;
  for (std::size_t i = 0; i < problem.records().size(); ++i) {
    Eigen::VectorXd values = problem.difference(machine, i);
    take_line(values);
    const std::span<const double> rows = view(values);
    if (!first) {
      const auto tone = strongest_tone(rows.first(std::min(rows.size(), kSearchRows)),
                                       machine.period, kLowestHum, highest);
      if (!tone) {
        return Hum::kNone;
      }
      first = tone_at(rows, machine.period, tone->frequency);
    }
    // The way is the integral of the velocity: a quarter of a turn behind it.
    const Tone tone = tone_at(rows, machine.period, first->frequency);
    const double phase =
        std::remainder(tone.phase + kTwoPi / 4.0 - kTwoPi * tone.frequency * start, kTwoPi);
    if (i == 0) {
      drive.hum_frequency_Hz = tone.frequency;
      drive.hum_amplitude = tone.amplitude * kTwoPi * tone.frequency / std::abs(scale);
      drive.hum_phase = scale < 0.0 ? std::remainder(phase + kTwoPi / 2.0, kTwoPi) : phase;
    }
    problem.hum_phase()[i] = i == 0 ? 0.0 : std::remainder(phase - drive.hum_phase, kTwoPi);
  }
  return Hum::kFound;
}

void align_hum(AxisProblem& problem) {
  if (!(problem.base().table.axis[problem.axis()].drive.hum_amplitude > 0.0)) {
    return;
  }
  for (std::size_t record = 1; record < problem.records().size(); ++record) {
    double best = 0.0;
    // A turn in steps, then finer and finer about the best.
    for (double step = kTwoPi / kPhases; step > kPhaseTolerance; step /= kPhases / 2.0) {
      std::array<double, kPhases + 1> costs{};
      const auto phase = [&](std::size_t i) {
        return best + step * (static_cast<double>(i) - kPhases / 2.0);
      };
      parallel_for(costs.size(), [&](std::size_t i) { costs[i] = problem.cost(record, phase(i)); });
      best = phase(static_cast<std::size_t>(std::ranges::min_element(costs) - costs.begin()));
    }
    problem.hum_phase()[record] = std::remainder(best, kTwoPi);
  }
}

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
