#include "hal/dac.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace twin::hal {

Dac::Dac(int bits) noexcept
    : step_(std::ldexp(2.0 * kRange, -bits)), half_(std::int64_t{1} << (bits - 1)) {
  assert(bits >= 2 && bits <= 48);
}

std::int64_t Dac::code(double volts) const noexcept {
  // Limited before it is rounded, so that no voltage overflows the integer.
  const double limited = std::clamp(volts, -2.0 * kRange, 2.0 * kRange);
  const std::int64_t code = std::llround(limited / step_) + half_;
  return std::clamp<std::int64_t>(code, 0, 2 * half_ - 1);
}

double Dac::volts(std::int64_t code) const noexcept {
  return static_cast<double>(code - half_) * step_;
}

}  // namespace twin::hal
