#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace twin::hal {

/// D/A converter in offset binary over +-10 V, as the PCI-1716's in that range.
///
/// With n bits and the step q = 20 V / 2^n the code of a voltage is
///   code = clamp(round(V / q) + 2^(n-1), 0, 2^n - 1)
/// so that 0 is -10 V, 2^(n-1) is 0 V and 2^n - 1 is +10 V - q.
class Dac {
 public:
  static constexpr double kRange = 10.0;  ///< [V]

  /// @param bits resolution n, 2 to 48
  explicit Dac(int bits) noexcept
      : step_(std::ldexp(2.0 * kRange, -bits)), half_(std::int64_t{1} << (bits - 1)) {
    assert(bits >= 2 && bits <= 48);
  }

  /// Code for a voltage [V], which must be finite. Real-time safe.
  std::int64_t code(double volts) const noexcept {
    // Limited before it is rounded, so that no voltage overflows the integer.
    const double limited = std::clamp(volts, -2.0 * kRange, 2.0 * kRange);
    const std::int64_t code = std::llround(limited / step_) + half_;
    return std::clamp<std::int64_t>(code, 0, 2 * half_ - 1);
  }
  /// Voltage at the terminals for a code [V]. Real-time safe.
  double volts(std::int64_t code) const noexcept {
    return static_cast<double>(code - half_) * step_;
  }
  /// What becomes of a voltage [V]: rounded to a code and limited. Real-time safe.
  double convert(double volts_in) const noexcept { return volts(code(volts_in)); }
  /// One step q [V].
  double step() const noexcept { return step_; }

 private:
  double step_;        // q [V]
  std::int64_t half_;  // code of 0 V
};

}  // namespace twin::hal
