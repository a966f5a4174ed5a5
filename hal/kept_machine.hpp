#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "hal/machine.hpp"

namespace twin::hal {

/// A machine that stays configured from one run to the next, so that a simulated one stands where
/// the last run left it, as a real one does. configure() works once, cleanup() is left to the end.
class KeptMachine final : public Machine {
 public:
  /// @param machine  unconfigured; outlives this
  explicit KeptMachine(Machine& machine) noexcept : machine_(machine) {}
  ~KeptMachine() override { machine_.cleanup(); }

  const MachineInfo& info() const noexcept override { return machine_.info(); }
  std::optional<Error> configure(double period) override;
  std::optional<Error> activate() override { return machine_.activate(); }
  Status read(Inputs& inputs) noexcept override;
  Status write(const Outputs& outputs) noexcept override { return machine_.write(outputs); }
  Truth truth() const noexcept override { return machine_.truth(); }
  void deactivate() noexcept override { machine_.deactivate(); }
  void cleanup() noexcept override { machine_.deactivate(); }
  std::string last_error() const override { return machine_.last_error(); }

  /// After a run: waits until the table stands, half a second without a count, at most five
  /// seconds.
  /// @returns how far the axes went on since the run's last read() [mm]
  std::array<double, kServoAxes> come_to_rest();

 private:
  Machine& machine_;
  double period_ = 0.0;                            // it is configured with [s]; 0: it is not
  std::array<std::int64_t, kServoAxes> counts_{};  // as last read
};

}  // namespace twin::hal
