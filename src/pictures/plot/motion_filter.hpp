#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/vec.hpp"

namespace twin::pictures {

/// Motion along the path at one set point.
struct TangentialMotion {
  double acceleration = 0.0;  ///< [mm/s^2]
  double jerk = 0.0;          ///< [mm/s^3]
};

/// Tangential acceleration and jerk of a stream of set points p_i = p(i T), by differences of the
/// arc length s.
///
/// With h periods of about 1 ms together, at the set point i
///   a = (s_{i+h} - 2 s_i + s_{i-h}) / (h T)^2
///   j = (s_{i+3h} - 3 s_{i+h} + 3 s_{i-h} - s_{i-3h}) / (2 h T)^3.
/// Each is a weighted mean of the true derivative, with positive weights, over 2 h T and 6 h T: it
/// smooths steps and exaggerates nothing. The arc length of a period is its chord c times (x/2) /
/// sin(x/2), x = kappa c the angle by which the path turns in it, and kappa from the circles
/// through three successive points, weighted
/// (-11 71 71 -11) / 120 over the four points around the period; chords alone would show a false
/// jerk wherever the curvature changes. Where a lone turn of more than 0.1 rad shows a corner, the
/// chord cuts it by an unknown length, and the mean feedrate of the two set points times T stands
/// for the arc. Before the first and after the last set point the machine is at rest.
class MotionFilter {
 public:
  /// @param period  interpolation period T [s]
  explicit MotionFilter(double period);

  /// Periods by which the answer lags behind the input.
  std::size_t delay() const noexcept { return 3 * step_ + 2; }

  /// Takes the next set point.
  ///
  /// @param point     [mm]
  /// @param feedrate  of the set point [mm/s], used at corners alone
  /// @returns the motion at the set point delay() earlier, or nothing when there is none yet
  std::optional<TangentialMotion> push(const Vec3& point, double feedrate);

 private:
  double arc_of_middle_period() const;
  double s(std::ptrdiff_t offset) const noexcept;

  double period_;
  std::size_t step_;                   // h
  std::size_t count_ = 0;              // points so far
  std::array<Vec3, 6> points_{};       // the last six
  std::array<double, 6> feedrates_{};  // of these
  std::vector<double> arcs_;           // ring of arc lengths s (6 h + 1)
};

}  // namespace twin::pictures
