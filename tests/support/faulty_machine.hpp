#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "hal/mujoco/mujoco_machine.hpp"

namespace twin::test {

/// The simulated table behind wires that can be cut, swapped or crossed from one period on.
class FaultyMachine final : public hal::Machine {
 public:
  explicit FaultyMachine(const hal::mujoco::TableParams& params)
      : table_(params), info_(table_.info()) {}

  std::function<void(std::int64_t, hal::Inputs&)> on_read;    ///< gets the number of the read
  std::function<void(std::int64_t, hal::Outputs&)> on_write;  ///< gets the number of the write
  hal::Outputs last_written;                                  ///< by the controller
  std::int64_t reads = 0;
  std::int64_t writes = 0;
  std::int64_t writes_after_off = 0;  ///< after a write without servo on, or deactivate()
  bool is_off = false;

  const hal::MachineInfo& info() const noexcept override { return info_; }
  std::optional<Error> configure(double period) override { return table_.configure(period); }
  std::optional<Error> activate() override { return table_.activate(); }
  hal::Status read(hal::Inputs& inputs) noexcept override {
    const auto status = table_.read(inputs);
    ++reads;
    if (on_read) {
      on_read(reads, inputs);
    }
    return status;
  }
  hal::Status write(const hal::Outputs& outputs) noexcept override {
    writes_after_off += is_off ? 1 : 0;
    is_off = is_off || !outputs.servo_on[0] || !outputs.servo_on[1];
    last_written = outputs;
    ++writes;
    hal::Outputs changed = outputs;
    if (on_write) {
      on_write(writes, changed);
    }
    return table_.write(changed);
  }
  hal::Truth truth() const noexcept override { return table_.truth(); }
  void deactivate() noexcept override {
    is_off = true;
    table_.deactivate();
  }
  void cleanup() noexcept override { table_.cleanup(); }
  std::string last_error() const override { return table_.last_error(); }

 private:
  hal::mujoco::MujocoMachine table_;
  hal::MachineInfo info_;
};

}  // namespace twin::test
