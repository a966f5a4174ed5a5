#include "hal/rig/boards/voltage_range.hpp"

#include <algorithm>
#include <cmath>

namespace twin::hal::rig::boards {
namespace {

constexpr int kBits = 16;
constexpr double kLargestCode = 65535.0;

VoltageRange bipolar(double peak) noexcept { return {-peak, std::ldexp(2.0 * peak, -kBits)}; }
VoltageRange unipolar(double peak) noexcept { return {0.0, std::ldexp(peak, -kBits)}; }

}  // namespace

VoltageRange analogue_output_range(std::uint16_t range_word, int channel) noexcept {
  switch ((range_word >> (8 * channel)) & 0x7) {
    case 0:
      return bipolar(5.0);
    case 1:
      return bipolar(10.0);
    case 2:
      return unipolar(5.0);
    case 3:
      return unipolar(10.0);
    default:  // 4 and 6: external reference, nothing is connected to it
      return {};
  }
}

VoltageRange analogue_input_range(std::uint16_t gain) noexcept {
  switch (gain & 0x17) {
    case 0x00:
      return bipolar(5.0);
    case 0x01:
      return bipolar(2.5);
    case 0x02:
      return bipolar(1.25);
    case 0x03:
      return bipolar(0.625);
    case 0x04:
      return bipolar(10.0);
    case 0x10:
      return unipolar(10.0);
    case 0x11:
      return unipolar(5.0);
    case 0x12:
      return unipolar(2.5);
    case 0x13:
      return unipolar(1.25);
    default:
      return {};
  }
}

double volts(const VoltageRange& range, std::uint16_t code) noexcept {
  // Every term is a whole number of steps, a power of two times the peak: exact, 0x8000 is 0.0.
  return range.low + static_cast<double>(code) * range.step;
}

std::uint16_t code(const VoltageRange& range, double volts) noexcept {
  if (range.step == 0.0) {
    return 0;
  }
  const double steps = std::round((volts - range.low) / range.step);
  return static_cast<std::uint16_t>(std::clamp(steps, 0.0, kLargestCode));
}

}  // namespace twin::hal::rig::boards
