#include "interpolator/parameter_update.hpp"

namespace twin::interpolator {

double taylor_step(const nurbs::Derivatives& at, double u, double feedrate, double acceleration,
                   double period) noexcept {
  const double pace = at.first.norm();
  if (!(pace > 0.0)) {
    return u;
  }
  const double bend = at.first.dot(at.second) / (pace * pace * pace);
  return u + feedrate / pace * period +
         (acceleration - bend * feedrate * feedrate) / pace * period * period / 2.0;
}

double corrected_parameter(const nurbs::Curve& curve, const nurbs::ArcLength& arc_length, double s,
                           double predicted) noexcept {
  return arc_length.u_at(curve, s, predicted);
}

}  // namespace twin::interpolator
