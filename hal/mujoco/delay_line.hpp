#pragma once

#include <cstddef>
#include <vector>

namespace twin::hal {

/// A value that arrives a fixed number of steps late; 0 until the first has arrived.
class DelayLine {
 public:
  /// @param steps delay in calls of step(), 0: none. Allocates.
  explicit DelayLine(std::size_t steps);

  /// Takes the value of this step and returns the one from `steps` calls ago. Real-time safe.
  double step(double value) noexcept;
  /// Fills the line with 0. Real-time safe.
  void clear() noexcept;

 private:
  std::vector<double> values_;  // ring
  std::size_t next_ = 0;
};

}  // namespace twin::hal
