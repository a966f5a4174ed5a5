#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "hal/mujoco/table_params.hpp"
#include "hal/rig/emulator/fault.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig::emulator {

/// How the emulated rig runs as a process of its own.
struct ServeSettings {
  std::string name{};                ///< of the shared memory; empty: default_shared_name()
  double step = 0.25e-3;             ///< plant time that passes at once [s]
  std::optional<double> duration{};  ///< ends after so long; none: runs until stopped [s]
  std::vector<Fault> faults{};
  std::function<void()> started{};  ///< called once a controller can attach; may be empty
};

/// What came of it.
struct ServeResult {
  double plant_time = 0.0;          ///< simulated time [s]
  double left_out = 0.0;            ///< time of the wall clock that was not simulated [s]
  std::int64_t steps = 0;           ///< steps of the plant
  std::int64_t late_steps = 0;      ///< begun more than a step after their time
  std::uint64_t lost_edges = 0;     ///< swallowed by the filters of the counters
  std::uint64_t unread_events = 0;  ///< events that came too thick to be told
};

/// Runs the emulated rig on the wall clock, its registers in shared memory, until `stop` or the end
/// of the duration.
///
/// The plant's time follows CLOCK_MONOTONIC in small steps, each begun at its time by an absolute
/// sleep; after a delay it catches up by 20 ms at most and leaves out the rest. What happens is
/// told line by line with both clocks: converters leaving and reaching 0x8000, digital outputs,
/// servos, alarms, faults, and the controller joining, leaving and dying. At the end both cards are
/// gone and the memory is removed.
///
/// @param tell  gets each line, without its end
/// @returns kMachine error: another emulator runs, or the simulation failed; kModel: no such model
Expected<ServeResult> serve(const mujoco::TableParams& table, const RigSettings& wiring,
                            const ServeSettings& settings, const std::atomic<bool>& stop,
                            const std::function<void(std::string_view)>& tell);

}  // namespace twin::hal::rig::emulator
