#include "studies/compensate/loop_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <numeric>

#include "studies/identify/axis_model.hpp"

namespace twin::studies::compensate {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;

constexpr std::size_t kRecord = 512;    // periods; resolves 2 Hz at 1 ms
constexpr std::size_t kHalfTaps = 160;  // of a filter either way
constexpr double kSpeed = 25.0;         // of the steady motion [mm/s]
constexpr double kAmplitude = 1e-4;     // of the sines [mm]
constexpr double kDistrust = 0.9;       // error of a response from which on it is not trusted
constexpr double kDoubt = 0.25;         // of mass, friction and loop gains
constexpr std::size_t kBlock = 1024;    // values that stay in the cache

/// Without encoder steps, converter steps and hum, so that the response to 0.1 um is seen.
identify::AxisSetup smooth_setup(const config::MachineFile& machine, std::size_t axis) {
  identify::AxisSetup setup = identify::axis_setup(machine, axis == 0 ? hal::kX : hal::kY);
  setup.axis.encoder.mm_per_count = std::copysign(1e-9, setup.axis.encoder.mm_per_count);
  setup.axis.dac_bits = 48;
  setup.axis.drive.hum_amplitude = 0.0;
  return setup;
}

/// A sum of sines of all frequencies of the record, with phases that keep it flat.
std::vector<double> excitation(std::size_t n) {
  std::vector<double> signal(n, 0.0);
  for (std::size_t i = 1; i < n / 2; ++i) {
    const auto f = static_cast<double>(i);
    const double phase = kPi * f * f / (0.5 * static_cast<double>(n));
    for (std::size_t k = 0; k < n; ++k) {
      const double turn = static_cast<double>((i * k) % n) / static_cast<double>(n);
      signal[k] +=
          kAmplitude / std::sqrt(static_cast<double>(n)) * std::cos(2.0 * kPi * turn + phase);
    }
  }
  return signal;
}

/// Positions of the slide in the third of three records of excitation.
std::vector<double> follow(const identify::AxisSetup& setup, std::span<const double> added) {
  const std::size_t n = added.size();
  const auto at = [&](std::size_t k) { return added[k % n]; };
  identify::AxisModel model(setup);
  model.settle(0.0);
  std::vector<double> out;
  const double t = setup.period;
  for (std::size_t k = 0; k < 3 * n; ++k) {
    const double before = at(k + n - 1);
    const double after = at(k + 1);
    const identify::AxisRow row = model.follow({kSpeed * t * static_cast<double>(k) + at(k),
                                                kSpeed + (after - before) / (2.0 * t),
                                                (after - 2.0 * at(k) + before) / (t * t)});
    if (k >= 2 * n) {
      out.push_back(row.table);
    }
  }
  return out;
}

Complex bin(std::span<const double> signal, std::size_t i) {
  Complex sum = 0.0;
  for (std::size_t k = 0; k < signal.size(); ++k) {
    const double turn =
        static_cast<double>((i * k) % signal.size()) / static_cast<double>(signal.size());
    sum += signal[k] * std::polar(1.0, -2.0 * kPi * turn);
  }
  return sum;
}

/// Taps of a response that is given at the bins of a record, with a window that ends at 0.
Filter taps_of(std::span<const Complex> response) {
  const std::size_t n = 2 * (response.size() - 1);
  const auto half = static_cast<std::ptrdiff_t>(std::min(kHalfTaps, n / 2 - 1));
  Filter filter;
  for (std::ptrdiff_t m = -half; m <= half; ++m) {
    double tap = response.front().real();
    for (std::size_t i = 1; i < response.size(); ++i) {
      const double angle =
          2.0 * kPi * static_cast<double>(i) * static_cast<double>(m) / static_cast<double>(n);
      const double weight = i + 1 == response.size() ? 1.0 : 2.0;
      tap += weight * (response[i] * std::polar(1.0, angle)).real();
    }
    const double window =
        0.5 + 0.5 * std::cos(kPi * static_cast<double>(m) / static_cast<double>(half + 1));
    filter.taps.push_back(window * tap / static_cast<double>(n));
  }
  return filter;
}

/// The machine, and the same with one thing at a time more and less.
std::vector<config::MachineFile> doubtful_models(const config::MachineFile& machine,
                                                 std::size_t axis) {
  std::vector<config::MachineFile> models{machine};
  for (const double factor : {1.0 - kDoubt, 1.0 + kDoubt}) {
    config::MachineFile mass = machine;
    mass.table.axis[axis].moving_mass *= factor;
    models.push_back(mass);
    config::MachineFile gain = machine;
    gain.table.axis[axis].drive.velocity_gain_Hz *= factor;
    models.push_back(gain);
    config::MachineFile integral = machine;
    integral.table.axis[axis].drive.integral_time *= factor;
    models.push_back(integral);
    config::MachineFile position = machine;
    position.servo[axis].kp *= factor;
    models.push_back(position);
    config::MachineFile friction = machine;
    friction.table.axis[axis].friction.coulomb *= factor;
    friction.table.axis[axis].friction.viscous *= factor;
    models.push_back(friction);
  }
  return models;
}

/// The highest frequency up to which the response holds on every model [Hz].
double trusted_up_to(const config::MachineFile& machine, std::size_t axis,
                     std::span<const Complex> nominal, double step, double highest) {
  double trusted = highest;
  for (const config::MachineFile& model : doubtful_models(machine, axis)) {
    const std::vector<Complex> response = loop_response(model, axis, kRecord);
    for (std::size_t i = 1; i < response.size(); ++i) {
      const double f = step * static_cast<double>(i);
      if (std::abs(1.0 - response[i] / nominal[i]) > kDistrust) {
        trusted = std::min(trusted, f - step);
        break;
      }
    }
  }
  return std::max(trusted, step);
}

}  // namespace

std::vector<Complex> loop_response(const config::MachineFile& machine, std::size_t axis,
                                   std::size_t n) {
  const identify::AxisSetup setup = smooth_setup(machine, axis);
  const std::vector<double> added = excitation(n);
  const std::vector<double> with = follow(setup, added);
  const std::vector<double> without = follow(setup, std::vector<double>(n, 0.0));
  std::vector<double> difference(n);
  std::ranges::transform(with, without, difference.begin(), std::minus<>());
  std::vector<Complex> response{1.0};
  for (std::size_t i = 1; i < n / 2; ++i) {
    response.push_back(bin(difference, i) / bin(added, i));
  }
  response.push_back(response.back());
  return response;
}

std::vector<double> Filter::apply(std::span<const double> signal) const {
  const std::size_t half = taps.size() / 2;
  const std::size_t count = signal.size();
  std::vector<double> padded(count + 2 * half, signal.front());
  std::ranges::copy(signal, padded.begin() + static_cast<std::ptrdiff_t>(half));
  std::fill(padded.end() - static_cast<std::ptrdiff_t>(half), padded.end(), signal.back());
  std::vector<double> out(count, 0.0);
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, count);
    for (std::size_t m = 0; m < taps.size(); ++m) {
      const double tap = taps[m];
      const double* const in = padded.data() + (taps.size() - 1 - m);
      for (std::size_t k = begin; k < end; ++k) {
        out[k] += tap * in[k];
      }
    }
  }
  return out;
}

std::vector<double> Filter::apply_transposed(std::span<const double> signal) const {
  const std::size_t half = taps.size() / 2;
  const std::size_t count = signal.size();
  std::vector<double> padded(count + 2 * half, 0.0);
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, count);
    for (std::size_t m = 0; m < taps.size(); ++m) {
      const double tap = taps[m];
      double* const out = padded.data() + (taps.size() - 1 - m);
      for (std::size_t k = begin; k < end; ++k) {
        out[k] += tap * signal[k];
      }
    }
  }
  const auto middle = padded.begin() + static_cast<std::ptrdiff_t>(half);
  std::vector<double> result(middle, middle + static_cast<std::ptrdiff_t>(count));
  result.front() += std::accumulate(padded.begin(), middle, 0.0);
  result.back() += std::accumulate(middle + static_cast<std::ptrdiff_t>(count), padded.end(), 0.0);
  return result;
}

AxisResponse axis_response(const config::MachineFile& machine, std::size_t axis, double highest) {
  const std::vector<Complex> nominal = loop_response(machine, axis, kRecord);
  const double step = 1.0 / (static_cast<double>(kRecord) * machine.period);
  AxisResponse response;
  response.trusted =
      trusted_up_to(machine, axis, nominal, step, std::min(highest, 0.4 / machine.period));
  response.filter = taps_of(nominal);
  return response;
}

}  // namespace twin::studies::compensate
