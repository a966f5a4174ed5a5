#include "hal/kept_machine.hpp"

#include <chrono>
#include <cmath>
#include <thread>

namespace twin::hal {

std::optional<Error> KeptMachine::configure(double period) {
  if (period_ == period) {
    return {};
  }
  auto error = machine_.configure(period);
  period_ = error ? 0.0 : period;
  return error;
}

Status KeptMachine::read(Inputs& inputs) noexcept {
  const Status status = machine_.read(inputs);
  if (status == Status::kOk) {
    counts_ = inputs.counts;
  }
  return status;
}

std::array<double, kServoAxes> KeptMachine::come_to_rest() {
  constexpr double kStill = 0.5;  // [s]
  const auto begin = counts_;
  const auto still_periods = static_cast<int>(std::ceil(kStill / period_));
  for (int i = 0, still = 0; i < 10 * still_periods && still < still_periods; ++i) {
    if (info().keeps_own_time) {
      std::this_thread::sleep_for(std::chrono::duration<double>(period_));
    }
    const auto before = counts_;
    Inputs inputs;
    if (read(inputs) != Status::kOk) {
      break;
    }
    still = counts_ == before ? still + 1 : 0;
  }
  std::array<double, kServoAxes> moved{};
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    moved[axis] = static_cast<double>(counts_[axis] - begin[axis]) * info().mm_per_count[axis];
  }
  return moved;
}

}  // namespace twin::hal
