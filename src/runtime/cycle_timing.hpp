#pragma once

#include <string>

#include "results/metrics/log_histogram.hpp"
#include "results/metrics/summary.hpp"
#include "results/trace/sample.hpp"

namespace twin::runtime {

/// Histograms of what the cycle measured on the wall clock.
class CycleTiming {
 public:
  void add(const results::Sample& sample) noexcept;

  /// The figures that come from samples; late periods and notes are known to the motion thread.
  results::RealTimeStats figures() const;

  /// Counts per bin of a sixteenth of an octave, "time_us,wake_up,compute,total", from the first
  /// bin that has any to the last; time_us is the bin's lower end.
  std::string to_csv() const;

 private:
  results::LogHistogram wake_up_;
  results::LogHistogram compute_;
  results::LogHistogram total_;
};

}  // namespace twin::runtime
