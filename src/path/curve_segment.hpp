#pragma once

#include "path/segment.hpp"

namespace twin::path {

/// Fills arc length and curvature of a curve that was just fitted.
void measure(FittedCurve& fitted);

/// Segment of a measured curve: geometry, length and both ends.
Segment make_curve_segment(FittedCurve&& fitted);

}  // namespace twin::path
