#pragma once

#include <array>
#include <optional>
#include <string>

#include "hal/machine.hpp"

namespace twin::hal::ideal {

/// A machine whose position equals the set point: what remains of an error is the planner's own.
///
/// The set point of period k is handed over by write() and is where the machine is at t_k. Because
/// read() comes first in a period, its counts are those of period k - 1; a recorder of rows
/// (command, measured) therefore takes truth() after write(), as info().follows_reference says.
/// Volts are accepted and have no effect.
class IdealMachine final : public Machine {
 public:
  IdealMachine();
  ~IdealMachine() override = default;

  const MachineInfo& info() const noexcept override { return info_; }
  State state() const noexcept { return state_; }
  std::optional<Error> configure(double period) override;
  std::optional<Error> activate() override;
  Status read(Inputs& inputs) noexcept override;
  Status write(const Outputs& outputs) noexcept override;
  Truth truth() const noexcept override;
  void deactivate() noexcept override;
  void cleanup() noexcept override;
  std::string last_error() const override;

 private:
  enum class Fault { kNone, kNotConfigured, kNotActive, kNotANumber };

  MachineInfo info_;
  State state_ = State::kUnconfigured;
  Fault fault_ = Fault::kNone;
  std::array<double, kServoAxes> position_{};  // of the last write() [mm]
  std::array<bool, kServoAxes> servo_on_{};
};

}  // namespace twin::hal::ideal
