#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "feedrate/limits/zones.hpp"
#include "feedrate/profile/phases.hpp"

namespace twin::test {

/// Phases one after the other, asked for the feedrate at a place.
class MotionProfile {
 public:
  explicit MotionProfile(std::vector<feedrate::Phase> phases) : phases_(std::move(phases)) {}

  const std::vector<feedrate::Phase>& phases() const { return phases_; }

  double duration() const {
    double sum = 0.0;
    for (const feedrate::Phase& phase : phases_) {
      sum += phase.duration;
    }
    return sum;
  }

  /// Feedrate where the profile passes s [mm/s].
  double feedrate_at(double s) const {
    auto next = std::upper_bound(
        phases_.begin(), phases_.end(), s,
        [](double place, const feedrate::Phase& phase) { return place < phase.s; });
    const feedrate::Phase& phase = next == phases_.begin() ? *next : *std::prev(next);
    return feedrate::motion_at(phase, feedrate::time_at(phase, s)).v;
  }

 private:
  std::vector<feedrate::Phase> phases_;
};

/// A time that no motion within the acceleration A alone can beat, whatever its jerk: forward and
/// backward over a grid, every grid cell at the highest feedrate that is possible anywhere in it.
inline double acceleration_bound(const std::vector<feedrate::LimitZone>& zones, double v_start,
                                 double v_end, double acceleration, int cells) {
  const double begin = zones.front().begin;
  const double step = (zones.back().end - begin) / cells;
  std::vector<double> square(static_cast<std::size_t>(cells) + 1, 0.0);
  std::vector<double> cell_limit(static_cast<std::size_t>(cells), 0.0);
  for (const feedrate::LimitZone& zone : zones) {
    const int from = std::clamp(static_cast<int>((zone.begin - begin) / step - 1e-6), 0, cells - 1);
    const int to = std::clamp(static_cast<int>((zone.end - begin) / step + 1e-6), 0, cells - 1);
    for (auto i = static_cast<std::size_t>(from);
         zone.end > zone.begin && i <= static_cast<std::size_t>(to); ++i) {
      cell_limit[i] = std::max(cell_limit[i], zone.limit);
    }
  }
  const double gain = 2.0 * acceleration * step;
  square.front() = v_start * v_start;
  for (std::size_t i = 0; i < cell_limit.size(); ++i) {
    square[i + 1] = std::min(square[i] + gain, cell_limit[i] * cell_limit[i]);
  }
  square.back() = std::min(square.back(), v_end * v_end);
  for (std::size_t i = cell_limit.size(); i-- > 0;) {
    square[i] = std::min(square[i], square[i + 1] + gain);
  }
  double time = 0.0;
  for (std::size_t i = 0; i < cell_limit.size(); ++i) {
    const double highest =
        std::min({square[i] + gain, square[i + 1] + gain, cell_limit[i] * cell_limit[i]});
    time += step / std::sqrt(highest);
  }
  return time;
}

}  // namespace twin::test
