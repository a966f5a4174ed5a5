#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "hal/machine.hpp"

namespace twin::test {

/// A machine whose position equals the set point, that remembers every set point it was given and
/// fails on purpose.
class FakeMachine final : public hal::Machine {
 public:
  FakeMachine() {
    info_.name = "fake";
    info_.follows_reference = true;
    info_.mm_per_count.fill(1e-6);
    info_.mm_per_s_per_volt.fill(100.0);
    references.reserve(200000);
  }

  std::int64_t read_that_fails = std::numeric_limits<std::int64_t>::max();
  std::int64_t write_that_fails = std::numeric_limits<std::int64_t>::max();
  bool fails_to_activate = false;
  std::function<void(std::int64_t)> on_write;  ///< gets the number of the write, from 1

  /// Its axes are real.
  void be_real() { info_.simulated = false; }
  /// Its time passes by itself.
  void keep_own_time() { info_.keeps_own_time = true; }

  std::vector<Vec3> references;  ///< set point of every period [mm]
  std::int64_t reads = 0;
  std::int64_t writes = 0;
  int activations = 0;
  int deactivations = 0;
  int cleanups = 0;

  const hal::MachineInfo& info() const noexcept override { return info_; }
  std::optional<Error> configure(double /*period*/) override { return {}; }
  std::optional<Error> activate() override {
    if (fails_to_activate) {
      return hal::refusal("main power is off");
    }
    ++activations;
    return {};
  }
  hal::Status read(hal::Inputs& inputs) noexcept override {
    inputs = {};
    inputs.servo_ready.fill(true);
    return ++reads >= read_that_fails ? hal::Status::kError : hal::Status::kOk;
  }
  hal::Status write(const hal::Outputs& outputs) noexcept override {
    if (++writes >= write_that_fails) {
      return hal::Status::kError;
    }
    const auto& reference = outputs.position_reference;
    position_ = {reference[0], reference[1]};
    if (references.size() < references.capacity()) {
      references.emplace_back(reference[0], reference[1], reference[2]);
    }
    if (on_write) {
      on_write(writes);
    }
    return hal::Status::kOk;
  }
  hal::Truth truth() const noexcept override { return {position_}; }
  void deactivate() noexcept override { ++deactivations; }
  void cleanup() noexcept override { ++cleanups; }
  std::string last_error() const override { return "alarm of drive X"; }

 private:
  hal::MachineInfo info_;
  std::array<double, hal::kServoAxes> position_{};
};

}  // namespace twin::test
