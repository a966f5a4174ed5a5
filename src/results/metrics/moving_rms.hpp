#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

namespace twin::results {

/// Root mean square of an error over the last stretch of time, which a picture shows in place of every single value.
class MovingRms {
 public:
  static constexpr double kTime = 0.1;  ///< [s]

  /// @param t      time of this value, not before that of the last one [s]
  /// @param error  in any unit
  /// @returns the root mean square of the values of the last kTime, this one among them
  double push(double t, double error) {
    squares_.push_back({t, error * error});
    sum_ += error * error;
    while (squares_.front()[0] < t - kTime) {
      sum_ -= squares_.front()[1];
      squares_.pop_front();
    }
    return std::sqrt(std::max(sum_, 0.0) / static_cast<double>(squares_.size()));
  }

 private:
  std::deque<std::array<double, 2>> squares_;  // time and square
  double sum_ = 0.0;                           // of the squares
};

}  // namespace twin::results
