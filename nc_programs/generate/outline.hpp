#pragma once

#include <vector>

#include "nc_programs/generate/rounding.hpp"

namespace twin::programs {

/// Closed smooth outline as a dense table over arc length s: place, tangent and curvature every few
/// micrometres.
class Outline {
 public:
  /// Chains the curves end to end (the last meets the first), with a round at every joint.
  /// @param curves  in order; the end of each is the start of the next
  Outline(const std::vector<FairCurve>& curves, const RoundShape& shape);

  /// Length once around [mm].
  [[nodiscard]] double length() const { return s_.back(); }
  /// Place at arc length s, 0 <= s <= length() [mm]; cubic Hermite between table entries.
  [[nodiscard]] Frame at(double s) const;
  /// Arc lengths of the table, 0 .. length() [mm].
  [[nodiscard]] const std::vector<double>& arc_lengths() const { return s_; }
  /// Frames at arc_lengths(); the last is the first again.
  [[nodiscard]] const std::vector<Frame>& frames() const { return frames_; }
  /// Arc length at a fraction of what the rounds left of curve i [mm].
  [[nodiscard]] double at_curve(std::size_t i, double fraction) const;

 private:
  void append(const Frame& frame, double ds);
  std::vector<double> s_;
  std::vector<Frame> frames_;
  std::vector<double> curve_begin_, curve_end_;
};

}  // namespace twin::programs
