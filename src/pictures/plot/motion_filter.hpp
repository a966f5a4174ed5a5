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

/// Computes tangential acceleration and jerk from a stream of set points p_i = p(i T), by
/// differences of the arc length s. The plots show them.
///
/// Let h be the number of periods in about 1 ms. At the set point i
///   a = (s_{i+h} - 2 s_i + s_{i-h}) / (h T)^2
///   j = (s_{i+3h} - 3 s_{i+h} + 3 s_{i-h} - s_{i-3h}) / (2 h T)^3.
/// Each value is a weighted mean of the true derivative, over 2 h T and 6 h T. All weights are
/// positive, so steps are smoothed and peaks are never exaggerated.
///
/// The arc length of a period is estimated from its chord c as c (x/2) / sin(x/2), where x = kappa
/// c is the angle by which the path turns in the period. Chords alone would show a false jerk
/// wherever the curvature changes. kappa is a mean of the curvatures of the circles through three
/// successive points, with the weights (-11 71 71 -11) / 120 at the four points around the period.
///
/// A single turn of more than 0.1 rad is a corner. The chord cuts the corner by an unknown length,
/// so the arc length there is taken as T times the mean feedrate of the two set points. Before the
/// first and after the last set point the machine is at rest.
class MotionFilter {
 public:
  /// @param period  interpolation period T [s]
  explicit MotionFilter(double period);

  /// Number of set points by which the result lags behind the input.
  std::size_t delay() const noexcept { return 3 * step_ + 2; }

  /// Takes the next set point.
  ///
  /// @param point     [mm]
  /// @param feedrate  feedrate of the set point, used at corners only [mm/s]
  /// @returns the motion at the set point delay() earlier; nothing before there is one
  std::optional<TangentialMotion> push(const Vec3& point, double feedrate);

 private:
  double arc_of_middle_period() const;
  double s(std::ptrdiff_t offset) const noexcept;

  double period_;
  std::size_t step_;                   // h
  std::size_t count_ = 0;              // number of set points so far
  std::array<Vec3, 6> points_{};       // the last six set points [mm]
  std::array<double, 6> feedrates_{};  // their feedrates [mm/s]
  std::vector<double> arcs_;           // ring of arc lengths s (6 h + 1)
};

}  // namespace twin::pictures
