#pragma once

#include <cstdint>

/// Codes of the PCI-1716's converters in volts, by range. Codes are straight binary in a unipolar
/// range and offset binary in a bipolar one.
namespace twin::hal::rig::boards {

/// Span of a 16-bit converter: code 0 is `low`, one step is `step`.
struct VoltageRange {
  double low = 0.0;   ///< [V]
  double step = 0.0;  ///< [V]; 0: no such range, or one by an external reference, which has 0 V
};

/// Range of a D/A channel. Real-time safe. @param range_word channel c in bits 8 c + 2 to 8 c
VoltageRange analogue_output_range(std::uint16_t range_word, int channel) noexcept;
/// Range of an A/D channel. Real-time safe. @param gain bits 2:0 gain, bit 4 unipolar
VoltageRange analogue_input_range(std::uint16_t gain) noexcept;

/// Voltage of a code [V]. Real-time safe.
double volts(const VoltageRange& range, std::uint16_t code) noexcept;
/// Code of a voltage [V], limited to the range; 0 where there is no range. Real-time safe.
std::uint16_t code(const VoltageRange& range, double volts) noexcept;

}  // namespace twin::hal::rig::boards
