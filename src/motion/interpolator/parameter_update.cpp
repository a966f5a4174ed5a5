#include "motion/interpolator/parameter_update.hpp"

namespace twin::motion {

double taylor_step(const geometry::Derivatives& at, double u, double feedrate, double acceleration,
                   double period) noexcept {
  const double pace = at.first.norm();
  if (!(pace > 0.0)) {
    return u;
  }
  const double bend = at.first.dot(at.second) / (pace * pace * pace);
  return u + feedrate / pace * period +
         (acceleration - bend * feedrate * feedrate) / pace * period * period / 2.0;
}

double first_order_step(const geometry::Derivatives& at, double u, double feedrate,
                        double period) noexcept {
  const double pace = at.first.norm();
  return pace > 0.0 ? u + feedrate / pace * period : u;
}

double runge_kutta_step(const geometry::Curve& curve, const geometry::Derivatives& at, double u,
                        const std::array<double, 3>& feedrate, double period) noexcept {
  const auto rate = [](const geometry::Derivatives& d, double v) {
    const double pace = d.first.norm();
    return pace > 0.0 ? v / pace : 0.0;
  };
  const auto [begin, middle, end] = feedrate;
  const double k1 = rate(at, begin);
  const double k2 = rate(curve.derivatives(u + 0.5 * period * k1), middle);
  const double k3 = rate(curve.derivatives(u + 0.5 * period * k2), middle);
  const double k4 = rate(curve.derivatives(u + period * k3), end);
  return u + period / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

double corrected_parameter(const geometry::Curve& curve, const geometry::ArcLength& arc_length,
                           double s, double predicted) noexcept {
  return arc_length.u_at(curve, s, predicted);
}

}  // namespace twin::motion
