#include "pictures/video/history.hpp"

#include <algorithm>
#include <cmath>

namespace twin::pictures::video {
namespace {

constexpr std::size_t kMostSteps = 2048;

}  // namespace

void History::add(const TraceRow& row, bool draws) {
  while (row.t >= length_ * static_cast<double>(kMostSteps)) {
    join_pairs();
  }
  const auto index = static_cast<std::size_t>(std::max(row.t, 0.0) / length_);
  if (index >= steps_.size()) {
    steps_.resize(index + 1, Step{row.feedrate, 0.0});
  }
  Step& step = steps_[index];
  step.feedrate = std::fmax(step.feedrate, row.feedrate);
  step.error_um = std::fmax(step.error_um, draws ? row.error_um : 0.0);
}

void History::join_pairs() {
  const std::size_t half = (steps_.size() + 1) / 2;
  for (std::size_t i = 0; i < half; ++i) {
    const Step a = steps_[2 * i];
    const Step b = 2 * i + 1 < steps_.size() ? steps_[2 * i + 1] : a;
    steps_[i] = {std::max(a.feedrate, b.feedrate), std::max(a.error_um, b.error_um)};
  }
  steps_.resize(half);
  length_ *= 2.0;
}

}  // namespace twin::pictures::video
