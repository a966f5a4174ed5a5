#pragma once

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

namespace twin::test {

/// One row of the fault table: what is broken, and what must happen.
struct FaultRow {
  std::string_view name;     ///< in hal/README.md
  std::string_view fault;    ///< as --fault takes it; the path begins 0.3 s after the servos
  std::string_view noticed;  ///< part of the message
  int periods;               ///< from the fault to 0 V on both converters, at most [1 ms]
};

/// Faults behind the wires, in simulated time, in the middle of a curve at 3,000 mm/min. Each must
/// end with exit status 1, one line that says what, when and at which NC line, both converters at
/// 0x8000, servos off, and trace.partial.csv and summary.partial.json kept.
inline constexpr std::array kFaultRows{
    FaultRow{"encoder frozen", "encoder_frozen:x@1", "axis x: encoder counts stand", 20},
    FaultRow{"counter stuck from the start", "encoder_frozen:y@0", "axis y: encoder counts stand",
             400},
    FaultRow{"200 edges lost at once", "encoder_lost_counts:x@1", "axis x: encoder jumped by", 2},
    FaultRow{"A and B swapped in motion", "encoder_swapped:y@1", "axis y: moves against its drive",
             20},
    FaultRow{"A and B swapped at rest", "encoder_swapped:x@0", "axis x: moves against its drive",
             60},
    FaultRow{"V-REF reversed in motion", "vref_reversed:x@1", "axis x: moves against its drive",
             20},
    FaultRow{"converter stuck", "dac_stuck:x@1", "axis x: tracking error", 400},
    FaultRow{"V-REF wire open", "vref_open:y@1", "axis y: encoder counts stand", 60},
    FaultRow{"servo-on lost", "servo_on_lost:y@1", "axis y: servo ready went off", 2},
    FaultRow{"drive alarm", "alarm:x@1", "axis x: drive alarm", 2},
    FaultRow{"ALM wire broken", "wire_broken:y@1", "axis y: drive alarm", 2},
    FaultRow{"P-OT", "limit_positive:x@1", "axis x: limit switch P-OT", 2},
    FaultRow{"N-OT", "limit_negative:y@1", "axis y: limit switch N-OT", 2},
    FaultRow{"PCI-1716 gone", "card_gone_1716@1", "the PCI-1716 no longer answers", 2},
    FaultRow{"PCI-1784 gone", "card_gone_1784@1", "the PCI-1784 no longer answers", 2},
};

/// The row as hal/README.md has it.
inline std::string to_markdown(const FaultRow& row) {
  return fmt::format("| {} | `--fault {}` | {} | {} |", row.name, row.fault, row.noticed,
                     row.periods);
}

}  // namespace twin::test
