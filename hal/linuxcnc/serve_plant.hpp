#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "hal/linuxcnc/plant_bench.hpp"
#include "hal/linuxcnc/segment.h"

namespace twin::hal::linuxcnc {

/// How a plant serves LinuxCNC.
struct ServeSettings {
  PlantSetup setup;
  std::string name{};                ///< of the shared memory; empty: default_segment_name()
  std::optional<double> duration{};  ///< ends after so much simulated time; none: when stopped [s]
  std::function<void(const std::string& name)> started{};  ///< told the memory's name; may be empty
  /// Gets every period before it is simulated: commands as asked, feedback as it was when they were
  /// computed. May be empty. An error ends the plant.
  std::function<Expected<void>(const twin_segment&)> record{};
  /// Told that no further period comes from the component that was attached. May be empty.
  std::function<Expected<void>()> left{};
};

/// What came of it.
struct ServeResult {
  double time = 0.0;            ///< simulated [s]
  std::uint64_t asked = 0;      ///< periods that the component asked for
  std::uint64_t simulated = 0;  ///< periods
};

/// Simulates a period for every period that a component of LinuxCNC asks for, until `stop` or the
/// end of the duration. Time stands while nobody asks.
///
/// What happens is told line by line: components that come, leave and die, periods that do not fit,
/// faults that strike. A component that is gone leaves 0 V and servo off.
///
/// @param tell  gets each line, without its end
/// @returns kMachine error: another plant runs, or the simulation failed; kModel: no such model
Expected<ServeResult> serve_plant(ServeSettings settings, const std::atomic<bool>& stop,
                                  const std::function<void(std::string_view)>& tell);

}  // namespace twin::hal::linuxcnc
