#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "hal/machine.hpp"

namespace twin::hal {

/// A machine that stays configured from one run to the next, so that a simulated one stands where
/// the last run left it, as a real one does.
///
/// configure() works once, cleanup() is left to the end, and activate() first lets the time of a
/// simulated table pass until it stands; a machine that keeps its own time waits for that by
/// itself.
class KeptMachine final : public Machine {
 public:
  /// @param machine  unconfigured; outlives this
  explicit KeptMachine(Machine& machine) noexcept : machine_(machine) {}
  ~KeptMachine() override { machine_.cleanup(); }

  const MachineInfo& info() const noexcept override { return machine_.info(); }
  Expected<void> configure(double period) override {
    if (period_ == period) {
      return {};
    }
    auto configured = machine_.configure(period);
    period_ = configured ? period : 0.0;
    return configured;
  }
  Expected<void> activate() override {
    if (!info().keeps_own_time) {
      come_to_rest();
    }
    return machine_.activate();
  }
  Status read(Inputs& inputs) noexcept override { return machine_.read(inputs); }
  Status write(const Outputs& outputs) noexcept override { return machine_.write(outputs); }
  Truth truth() const noexcept override { return machine_.truth(); }
  void deactivate() noexcept override { machine_.deactivate(); }
  void cleanup() noexcept override { machine_.deactivate(); }
  std::string last_error() const override { return machine_.last_error(); }

 private:
  /// Half a second without a count, at most five seconds.
  void come_to_rest() {
    const auto half = static_cast<int>(std::ceil(0.5 / period_));
    Inputs inputs;
    std::array<std::int64_t, kServoAxes> counts{};
    for (int i = 0, still = 0; i < 10 * half && still < half; ++i) {
      if (machine_.read(inputs) != Status::kOk) {
        return;
      }
      still = inputs.counts == counts ? still + 1 : 0;
      counts = inputs.counts;
    }
  }

  Machine& machine_;
  double period_ = 0.0;  // it is configured with [s]; 0: it is not
};

}  // namespace twin::hal
