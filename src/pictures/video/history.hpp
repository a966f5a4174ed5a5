#pragma once

#include <vector>

#include "pictures/video/trace_rows.hpp"

namespace twin::pictures::video {

/// Largest feedrate and contour error over time, in at most 2,048 steps of equal length; the steps
/// become longer as time goes on, so memory does not grow with the trace.
class History {
 public:
  struct Step {
    double feedrate = 0.0;  ///< largest in this step [mm/s]
    double error_um = 0.0;  ///< largest where the pen draws [um]
  };

  /// @param draws  whether the pen is down, so that the row's error counts
  void add(const TraceRow& row, bool draws);

  const std::vector<Step>& steps() const noexcept { return steps_; }
  double step_length() const noexcept { return length_; }  ///< [s]

 private:
  void join_pairs();

  std::vector<Step> steps_;
  double length_ = 1e-3;  // [s]
};

}  // namespace twin::pictures::video
