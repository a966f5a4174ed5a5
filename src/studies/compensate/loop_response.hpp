#pragma once

#include <complex>
#include <span>
#include <vector>

#include "config/machine_file.hpp"

namespace twin::studies::compensate {

/// Frequency response from a small offset of the set point, with its velocity and acceleration, to
/// the position of the slide, for one axis that slides steadily.
///
/// Bin i is the frequency i / (n T), i = 0 .. n / 2, with n = 2 (size - 1) periods; bin 0 is 1.
/// It is measured on the model: the same motion with and without a sum of sines.
/// @param axis  0 for x, 1 for y
/// @param n     periods of the record, even
std::vector<std::complex<double>> loop_response(const config::MachineFile& machine,
                                                std::size_t axis, std::size_t n);

/// A filter without delay: as many taps ahead as behind. out_k = sum_m tap_m in_(k-m).
struct Filter {
  std::vector<double> taps;  ///< from -m to m (2 m + 1)

  /// Filters a signal, which goes on with its first and its last value at either end.
  std::vector<double> apply(std::span<const double> signal) const;
  /// The transpose of apply(), which is linear.
  std::vector<double> apply_transposed(std::span<const double> signal) const;
};

/// The response of one axis of the model as a filter, and how far it may be trusted.
struct AxisResponse {
  Filter filter;
  double trusted = 0.0;  ///< frequency up to which it is [Hz]
};

/// Measures the response of one axis.
///
/// With G of the model and G_i of models whose mass, friction and loop gains are up to 25 % off, it
/// is trusted up to the frequency where |1 - G_i / G| first exceeds kDistrust for some i: an
/// iteration that undoes errors by G with a gain g then leaves |1 - g G_i / G| < 1 on each of them,
/// so that it converges. It is not trusted beyond `highest`.
/// @param highest  [Hz]
AxisResponse axis_response(const config::MachineFile& machine, std::size_t axis, double highest);

}  // namespace twin::studies::compensate
