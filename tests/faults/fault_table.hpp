#pragma once

#include <array>
#include <string>
#include <string_view>

namespace twin::test {

/// One row of the fault table: what is broken, and what must happen.
struct FaultRow {
  std::string_view name;     ///< in hal/README.md
  std::string_view fault;    ///< as --fault takes it, at 1 s: in the middle of a curve
  std::string_view noticed;  ///< part of the message
  int periods;               ///< from the fault to 0 V on both converters, at most [1 ms]
};

/// Faults behind the wires, in simulated time. Each must end with exit status 1, one line that names
/// axis, value, limit, time and NC line, both converters at 0x8000, servos off, and trace.partial.csv
/// and summary.partial.json kept.
inline constexpr std::array kFaultRows{
    FaultRow{"encoder frozen", "encoder_frozen:x@1", "axis x: encoder counts stand", 60},
    FaultRow{"encoder lost counts", "encoder_lost_counts:x@1", "axis x: encoder jumped by", 2},
    FaultRow{"encoder A and B swapped", "encoder_swapped:y@1", "axis y: ", 20},
    FaultRow{"converter stuck", "dac_stuck:x@1", "axis x: ", 200},
    FaultRow{"V-REF reversed", "vref_reversed:x@1", "axis x: ", 20},
    FaultRow{"V-REF wire open", "vref_open:x@1", "axis x: ", 200},
    FaultRow{"servo-on lost", "servo_on_lost:y@1", "axis y: servo ready went off", 2},
    FaultRow{"drive alarm", "alarm:x@1", "axis x: drive alarm", 2},
    FaultRow{"ALM wire broken", "wire_broken:y@1", "axis y: drive alarm", 2},
    FaultRow{"P-OT", "limit_positive:x@1", "axis x: limit switch P-OT", 2},
    FaultRow{"N-OT", "limit_negative:y@1", "axis y: limit switch N-OT", 2},
    FaultRow{"PCI-1716 gone", "card_gone_1716@1", "PCI-1716", 2},
    FaultRow{"PCI-1784 gone", "card_gone_1784@1", "PCI-1784", 2},
};

}  // namespace twin::test
