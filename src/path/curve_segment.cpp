#include "path/curve_segment.hpp"

#include <utility>

namespace twin::path {

void measure(FittedCurve& fitted) { fitted.arc_length.build(fitted.curve, &fitted.curvature); }

Segment make_curve_segment(FittedCurve&& fitted) {
  Segment segment;
  segment.length = fitted.arc_length.length();
  segment.begin = point_from(fitted.curve.derivatives(fitted.curve.u_min()));
  segment.end = point_from(fitted.curve.derivatives(fitted.curve.u_max()));
  segment.geometry = std::move(fitted);
  return segment;
}

}  // namespace twin::path
