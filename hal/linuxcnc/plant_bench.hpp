#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "hal/dac.hpp"
#include "hal/linuxcnc/segment.h"
#include "hal/machine.hpp"
#include "hal/mujoco/table_plant.hpp"
#include "hal/rig/emulator/fault.hpp"
#include "hal/rig/emulator/shaft.hpp"

namespace twin::hal::linuxcnc {

/// What a plant behind LinuxCNC simulates.
struct PlantSetup {
  mujoco::TableParams table;
  double period = 0.001;                            ///< of a question [s]
  std::array<bool, kServoAxes> home_is_positive{};  ///< home switch is P-OT; else N-OT
  std::vector<rig::emulator::Fault> faults{};       ///< that strike by their time
};

/// The simulated table behind the memory that it shares with LinuxCNC.
///
///   volts -> converter -> TablePlant -> Shaft -> counts, index     axes x, y
///   set point -> pen slide -> position                             axis z
///
/// Faults strike at their time, or as long as the component injects them. An index mark passes once
/// a revolution, half a revolution from where the shaft stood at the beginning.
class PlantBench {
 public:
  static Expected<std::unique_ptr<PlantBench>> open(PlantSetup setup);

  /// Writes names, kinds and scales of the axes and the period.
  void describe(twin_segment& memory) const noexcept;
  /// Lets one period pass with the commands in the memory. Real-time safe.
  /// @returns false if the simulation failed, as last_error() says
  bool advance(const twin_segment& memory) noexcept;
  /// Writes feedback and time. Real-time safe.
  void show(twin_segment& memory) const noexcept;
  /// 0 V and servo off, for a component that is gone. Real-time safe.
  void switch_off() noexcept;

  double time() const noexcept { return plant_->time(); }
  std::string last_error() const { return plant_->last_error(); }
  /// Faults that have struck by their time since the last call, in order.
  std::vector<rig::emulator::Fault> take_struck();

 private:
  using Kind = rig::emulator::FaultKind;

  struct Axis {
    std::bitset<rig::emulator::kFaultKinds> broken;    // by its time, for good
    std::bitset<rig::emulator::kFaultKinds> injected;  // by the component, as of now
    double volts = 0.0;                                // of the converter [V]
    double stuck_volts = 0.0;                          // of a converter that is stuck [V]
    std::int64_t counts = 0;
    std::int64_t index_counts = 0;
    std::uint32_t index_marks = 0;
    std::int64_t edges_slipped = 0;  // that came while the encoder slips
    std::int64_t edges_to_lose = 0;
    bool is_resetting = false;
    std::optional<double> first_ready;  // [s]
  };

  PlantBench(PlantSetup setup, std::unique_ptr<mujoco::TablePlant> plant);
  void strike_due() noexcept;
  void break_now(const rig::emulator::Fault& fault) noexcept;
  void take_injected(std::size_t axis, std::uint32_t faults) noexcept;
  void drive(std::size_t axis, const twin_command& command) noexcept;
  void count(std::size_t axis) noexcept;
  bool is_broken(std::size_t axis, Kind kind) const noexcept;

  PlantSetup setup_;
  std::unique_ptr<mujoco::TablePlant> plant_;
  std::vector<Dac> dacs_;
  std::vector<rig::emulator::Shaft> shafts_;
  std::array<Axis, kServoAxes> axes_{};
  std::vector<char> struck_;  // of each fault: 1, and 2 once it was told
};

}  // namespace twin::hal::linuxcnc
