#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/mujoco/table_plant.hpp"
#include "hal/rig/bench.hpp"
#include "hal/rig/boards/board_registers.hpp"
#include "hal/rig/boards/quadrature_inputs.hpp"
#include "hal/rig/emulator/event_log.hpp"
#include "hal/rig/emulator/fault.hpp"
#include "hal/rig/emulator/shaft.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig::emulator {

/// Both cards, the drives and the table: emulated boards whose wires end in TablePlant.
///
///   DAC code -> volts by range -> V-REF  \                 / edges -> counters
///   DO bits -> /S-ON, /ALM-RST            } -> TablePlant {  ALM, /S-RDY, P-OT, N-OT -> DI bits
///   analogue inputs <- volts             /                 \ true position
///
/// advance() lets one period pass with what stands at the boards, and shows the result there. The
/// same voltages give the same bytes as MujocoMachine. Analogue input n sees DAC n, and an input
/// that is wired as read-back sees V-REF of its axis.
///
/// A reset of an alarm works on the rising edge of its line, seen by advance(). Digital inputs that
/// are not wired are 0.
class EmulatedRig final : public Bench {
 public:
  /// @param wiring   how the wires truly run, whatever a driver believes
  /// @param boards   registers that live longer than this; null: own ones
  EmulatedRig(mujoco::TableParams table, RigSettings wiring, std::vector<Fault> faults = {},
              boards::BoardRegisters* boards = nullptr);

  /// Cards, drives and table are switched on anew.
  Expected<void> power_on(double period) override;
  bool advance() noexcept override;
  Truth truth() const noexcept override;
  void set_pen_reference(double z) noexcept override;
  std::string last_error() const override;

  boards::BoardRegisters& boards() noexcept { return *boards_; }
  /// What happened. For the thread that calls advance().
  EventLog& events() noexcept { return events_; }
  /// What happened and how it ended, a line each. For the thread that calls advance().
  std::string report() const;
  /// Breaks something now, whatever its time. Real-time safe.
  void inject(const Fault& fault) noexcept;
  /// Simulated time since power on [s].
  double time() const noexcept { return plant_ ? plant_->time() : 0.0; }
  /// Edges that the counters' filters have swallowed.
  std::uint64_t lost_edges() const noexcept { return inputs_ ? inputs_->lost_edges() : 0; }
  /// The drives and the table; null before power on.
  mujoco::TablePlant* plant() noexcept { return plant_.get(); }

 private:
  struct AxisState {
    std::bitset<kFaultKinds> broken;
    double stuck_volts = 0.0;         // V-REF while the converter is stuck [V]
    double vref = 0.0;                // at the terminals [V]
    std::int64_t edges_to_lose = 0;   // by kEncoderLostCounts
    std::uint64_t edges_slipped = 0;  // that came while slipping
    bool is_resetting = false;
    bool is_ready = false;
    bool has_alarm = false;
    bool is_limit_positive = false;
    bool is_limit_negative = false;
    std::optional<double> first_ready;  // [s]
  };

  void strike_due_faults() noexcept;
  double dac_volts(std::size_t axis) const noexcept;
  void drive(std::size_t axis, std::uint16_t digital_out) noexcept;
  boards::EncoderMotion encoder_motion(std::size_t axis) noexcept;
  void show_counters() noexcept;
  void show_inputs() noexcept;
  void show_analogue() noexcept;
  void notice(std::size_t axis) noexcept;
  void notice_outputs(std::uint16_t digital_out) noexcept;
  void tell(EventKind kind, std::size_t index, std::int64_t value) noexcept;
  bool is_broken(std::size_t axis, FaultKind kind) const noexcept {
    return state_[axis].broken.test(static_cast<std::size_t>(kind));
  }

  mujoco::TableParams table_;
  RigSettings wiring_;
  std::vector<Fault> faults_;
  std::vector<char> struck_;  // of each fault
  std::unique_ptr<boards::BoardRegisters> own_;
  boards::BoardRegisters* boards_;
  EventLog events_;
  std::unique_ptr<mujoco::TablePlant> plant_;
  std::vector<Shaft> shafts_;
  std::optional<boards::QuadratureInputs> inputs_;
  std::array<AxisState, kServoAxes> state_{};
  std::array<RestWatch, 2> rest_{};
  std::array<double, kServoAxes> origin_{};  // of truth() [mm]
  std::uint16_t digital_out_ = 0;            // as last seen
  double period_ = 0.0;                      // [s]
};

}  // namespace twin::hal::rig::emulator
