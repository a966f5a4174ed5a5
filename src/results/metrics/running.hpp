#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace twin::results {

/// Count, extremes, mean and root mean square of a stream of numbers, in constant memory.
///
/// Both sums are compensated (Kahan), so that they keep their last digits over 10^9 terms. A number
/// that is not finite makes the sums not finite, so that it cannot pass unnoticed.
class Running {
 public:
  void add(double x) noexcept {
    ++count_;
    min_ = std::min(min_, x);
    max_ = std::max(max_, x);
    sum_.add(x);
    squares_.add(x * x);
  }

  std::int64_t count() const noexcept { return count_; }
  double min() const noexcept { return count_ == 0 ? 0.0 : min_; }
  double max() const noexcept { return count_ == 0 ? 0.0 : max_; }
  double sum() const noexcept { return sum_.value; }
  double mean() const noexcept { return count_ == 0 ? 0.0 : sum_.value / number(); }
  double rms() const noexcept { return count_ == 0 ? 0.0 : std::sqrt(squares_.value / number()); }

 private:
  struct Sum {
    double value = 0.0;
    double lost = 0.0;  // low-order part that value could not hold
    void add(double x) noexcept {
      const double y = x - lost;
      const double next = value + y;
      lost = (next - value) - y;
      value = next;
    }
  };
  double number() const noexcept { return static_cast<double>(count_); }

  std::int64_t count_ = 0;
  double min_ = std::numeric_limits<double>::infinity();
  double max_ = -std::numeric_limits<double>::infinity();
  Sum sum_;
  Sum squares_;
};

}  // namespace twin::results
