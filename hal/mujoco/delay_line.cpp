#include "hal/mujoco/delay_line.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace twin::hal::mujoco {
namespace {

constexpr double kWholeSteps = 1e-9;  // how far from whole a count of steps may be [steps]

std::size_t whole_part(double steps) {
  assert(steps >= 0.0);
  return static_cast<std::size_t>(std::floor(steps + kWholeSteps));
}

}  // namespace

DelayLine::DelayLine(double steps)
    : values_(whole_part(steps), 0.0),
      fraction_(std::max(steps - static_cast<double>(values_.size()), 0.0)) {
  if (fraction_ < kWholeSteps) {
    fraction_ = 0.0;
  }
}

double DelayLine::whole_step(double value) noexcept {
  if (values_.empty()) {
    return value;
  }
  const double delayed = values_[next_];
  values_[next_] = value;
  next_ = next_ + 1 == values_.size() ? 0 : next_ + 1;
  return delayed;
}

double DelayLine::step(double value) noexcept {
  const double delayed = whole_step(value);
  const double mean = delayed + fraction_ * (last_ - delayed);
  last_ = delayed;
  return mean;
}

void DelayLine::fill(double value) noexcept {
  std::fill(values_.begin(), values_.end(), value);
  last_ = value;
}

void DelayLine::clear() noexcept { fill(0.0); }

}  // namespace twin::hal::mujoco
