#pragma once

#include <cstdint>

#include "feedrate/profile/phases.hpp"
#include "motion/motion_settings.hpp"
#include "path/segment.hpp"

namespace twin::motion {

/// Goes along one curve after the other and finds the parameter of each set point.
///
/// With ParameterUpdate::kCorrected the parameter is that of the planned arc length. The other
/// updates integrate du/dt = V / |C'| from set point to set point and never look at the arc length,
/// as published; their error adds up along a curve and ends with it.
class CurveFollower {
 public:
  /// What gives the parameter of a set point.
  enum class Basis : std::uint8_t {
    kUpdate,     ///< the parameter update of the settings
    kArcLength,  ///< the planned arc length, whatever the update: braking and after it
  };

  explicit CurveFollower(ParameterUpdate update) : update_(update) {}

  /// A new segment begins, with this motion. Real-time safe.
  void enter(const feedrate::PathMotion& begin) noexcept {
    has_u_ = false;
    last_ = begin;
  }

  /// The next set point of the curve.
  ///
  /// @param to       motion along the path there
  /// @param elapsed  time since the last set point, or since the curve's begin if that is later [s]
  /// @param period   interpolation period T [s]
  /// @note Real-time safe.
  path::PathPoint follow(const path::FittedCurve& fitted, const feedrate::PathMotion& to,
                         double elapsed, double period, Basis basis) noexcept;

 private:
  double integrated(const geometry::Curve& curve, const feedrate::PathMotion& to,
                    double elapsed) const noexcept;

  ParameterUpdate update_;
  feedrate::PathMotion last_{};  // at the last set point, or where the segment begins
  double u_ = 0.0;               // parameter of the last set point on this curve
  bool has_u_ = false;
  geometry::Derivatives at_u_{};
};

}  // namespace twin::motion
