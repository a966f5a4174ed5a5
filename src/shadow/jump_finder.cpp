#include "shadow/jump_finder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace twin::shadow {
namespace {

double square_of(const std::vector<double>& shape, std::size_t periods) {
  double sum = 0.0;
  for (std::size_t j = 0; j < std::min(periods, shape.size()); ++j) {
    sum += shape[j] * shape[j];
  }
  return sum;
}

}  // namespace

JumpFinder::JumpFinder(JumpShapes shapes, double variance, std::size_t block)
    : shapes_(std::move(shapes)),
      memory_(std::min(kMemory, shapes_.step.size())),
      variance_(variance),
      price_(2.0 * std::log(static_cast<double>(block))),
      step_square_(square_of(shapes_.step, memory_)),
      force_square_(square_of(shapes_.force, memory_)),
      residuals_(2 * memory_),
      to_come_(std::max(shapes_.step.size(), std::size_t{1}), 0.0) {}

void JumpFinder::reset() noexcept {
  filled_ = 0;
  pending_ = {};
  std::ranges::fill(to_come_, 0.0);
}

double JumpFinder::correlation(const std::vector<double>& shape) const noexcept {
  double sum = 0.0;
  for (std::size_t j = 0; j < memory_; ++j) {
    sum += shape[j] * residuals_[next_ + j];
  }
  return sum;
}

JumpFinder::Found JumpFinder::judge(double direction) const noexcept {
  Found here;
  if (direction != 0.0) {
    const double sum = correlation(shapes_.step);
    const double count = -direction * shapes_.count;
    const double lost = std::max(std::round(sum / (step_square_ * count)), 1.0);
    here.step = lost * count;
    here.counts = {here.step * (2.0 * sum - here.step * step_square_) / variance_ - price_, lost};
  }
  if (!shapes_.force.empty()) {
    const double sum = correlation(shapes_.force);
    here.force = {sum * sum / (force_square_ * variance_) - price_, sum / force_square_};
  }
  return here;
}

/// Takes a jump that began `age` periods before the oldest residual off those that are there and off
/// those that come.
void JumpFinder::take_off(const Found& jump, std::size_t age) noexcept {
  const bool is_count = jump.counts.gain >= jump.force.gain;
  const std::vector<double>& shape = is_count ? shapes_.step : shapes_.force;
  const double size = is_count ? jump.step : jump.force.size;
  for (std::size_t i = 0; i < memory_ && age + i < shape.size(); ++i) {
    const std::size_t at = (next_ + i) % memory_;
    residuals_[at] -= size * shape[age + i];
    residuals_[at + memory_] = residuals_[at];
  }
  for (std::size_t i = memory_ + age; i < shape.size(); ++i) {
    to_come_[(coming_ + i - memory_ - age) % to_come_.size()] += size * shape[i];
  }
}

JumpFinder::Found JumpFinder::step(double residual, double direction) noexcept {
  if (memory_ == 0 || shapes_.count <= 0.0) {
    return {};
  }
  residual -= std::exchange(to_come_[coming_], 0.0);
  coming_ = coming_ + 1 == to_come_.size() ? 0 : coming_ + 1;
  residuals_[next_] = residuals_[next_ + memory_] = residual;
  next_ = next_ + 1 == memory_ ? 0 : next_ + 1;
  filled_ = std::min(filled_ + 1, memory_);
  if (filled_ < memory_) {
    return {};
  }
  const Found here = judge(direction);
  ++age_;
  if (here.gain() > std::max(pending_.gain(), 0.0)) {
    pending_ = here;
    age_ = 0;
  } else if (pending_.gain() > 0.0 && age_ >= memory_ / 2) {
    take_off(pending_, age_);
    return std::exchange(pending_, Found{});
  }
  return {};
}

}  // namespace twin::shadow
