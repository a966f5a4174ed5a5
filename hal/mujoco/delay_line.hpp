#pragma once

#include <cstddef>
#include <vector>

namespace twin::hal::mujoco {

/// A value that arrives a fixed time late; 0 until the first has arrived.
///
/// The value of step k holds over that step. Late by n + f steps, n whole and 0 <= f < 1, the value
/// changes inside a step, and its mean over step k is
///   y_k = (1 - f) v_{k-n} + f v_{k-n-1}.
class DelayLine {
 public:
  /// @param steps delay n + f >= 0 in calls of step(); 0: none. Allocates.
  explicit DelayLine(double steps);

  /// Makes a value the past. Real-time safe.
  void fill(double value) noexcept;
  /// Takes the value of this step and returns the mean of what arrives during it. Real-time safe.
  double step(double value) noexcept;
  /// Fills the line with 0. Real-time safe.
  void clear() noexcept;

 private:
  double whole_step(double value) noexcept;

  std::vector<double> values_;  // ring of n
  std::size_t next_ = 0;
  double fraction_;    // f
  double last_ = 0.0;  // v_{k-n-1}
};

}  // namespace twin::hal::mujoco
