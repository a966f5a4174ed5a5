#include "hal/mujoco/delay_line.hpp"

#include <algorithm>

namespace twin::hal {

DelayLine::DelayLine(std::size_t steps) : values_(steps, 0.0) {}

double DelayLine::step(double value) noexcept {
  if (values_.empty()) {
    return value;
  }
  const double delayed = values_[next_];
  values_[next_] = value;
  next_ = next_ + 1 == values_.size() ? 0 : next_ + 1;
  return delayed;
}

void DelayLine::clear() noexcept { std::fill(values_.begin(), values_.end(), 0.0); }

}  // namespace twin::hal
