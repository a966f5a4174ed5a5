#include "motion/interpolator/curve_follower.hpp"

#include <algorithm>

#include "motion/interpolator/parameter_update.hpp"

namespace twin::motion {

double CurveFollower::integrated(const geometry::Curve& curve, const feedrate::PathMotion& to,
                                 double elapsed) const noexcept {
  switch (update_) {
    case ParameterUpdate::kTaylor1:
      return first_order_step(at_u_, u_, last_.v, elapsed);
    case ParameterUpdate::kRungeKutta4: {
      // In between, the feedrate of the cubic through both ends with their accelerations.
      const double middle = 0.5 * (last_.v + to.v) + 0.125 * elapsed * (last_.a - to.a);
      return runge_kutta_step(curve, at_u_, u_, {last_.v, middle, to.v}, elapsed);
    }
    case ParameterUpdate::kTaylor2:
    case ParameterUpdate::kCorrected:
      break;
  }
  return taylor_step(at_u_, u_, last_.v, last_.a, elapsed);
}

path::PathPoint CurveFollower::follow(const path::FittedCurve& fitted,
                                      const feedrate::PathMotion& to, double elapsed, double period,
                                      Basis basis) noexcept {
  const geometry::Curve& curve = fitted.curve;
  if (basis == Basis::kArcLength || update_ == ParameterUpdate::kCorrected) {
    const double predicted = has_u_ ? taylor_step(at_u_, u_, to.v, to.a, period) : to.s;
    u_ = corrected_parameter(curve, fitted.arc_length, to.s, predicted);
  } else {
    if (!has_u_) {
      u_ = curve.u_min();
      at_u_ = curve.derivatives(u_);
    }
    u_ = std::clamp(integrated(curve, to, elapsed), curve.u_min(), curve.u_max());
  }
  at_u_ = curve.derivatives(u_);
  has_u_ = true;
  last_ = to;
  return path::point_from(at_u_);
}

}  // namespace twin::motion
