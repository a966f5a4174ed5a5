#include "results/metrics/feedrate_fluctuation.hpp"

#include <algorithm>
#include <cmath>

namespace twin::results {
namespace {

constexpr double kSlowest = 1.0;  // [mm/s]

}  // namespace

std::optional<double> FeedrateFluctuation::add(const Vec3& point, double feedrate) noexcept {
  std::shift_left(feedrates_.begin(), feedrates_.end(), 1);
  feedrates_.back() = feedrate;
  const Step step = step_;
  if (count_ == 0) {
    steps_.reset(point);
    feedrates_.fill(feedrate);
  } else {
    step_ = steps_.push(point);
  }
  count_ = std::min(count_ + 1, kDelay + 2);
  if (count_ < kDelay + 2) {
    return std::nullopt;
  }
  const auto third = [&](std::size_t i) {
    const double* v = feedrates_.data() + i;
    return std::abs(v[3] - 3.0 * v[2] + 3.0 * v[1] - v[0]);
  };
  // The period from feedrates_[2] to feedrates_[3].
  const double* v = feedrates_.data() + 1;
  const double commanded = 0.5 * (v[1] + v[2]) - (v[3] - v[2] - v[1] + v[0]) / 24.0;
  if (commanded < kSlowest || step.doubt > step.chord) {
    return std::nullopt;
  }
  const double doubt = step.doubt / period_ + std::max({third(0), third(1), third(2)}) / 12.0;
  const double off = std::abs(step.arc / period_ - commanded);
  const double share = std::max(off - doubt, 0.0) / commanded;
  shares_.add(share);
  return share;
}

}  // namespace twin::results
