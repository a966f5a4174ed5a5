#include "feedrate/window_planner.hpp"

#include <algorithm>

#include "feedrate/profile/ramp.hpp"

namespace twin::feedrate {

bool raise_limits(Window& window, double last, const RampLimits& ramp) {
  const Knot& start = window.start;
  const double to = std::min(last, start.s + longest_descent(start.v, start.v, ramp));
  bool is_raised = false;
  for (LimitZone& zone : window.zones) {
    if (zone.end > start.s && zone.begin < to && zone.limit > 0.0 && zone.limit < start.v) {
      zone.limit = start.v;
      is_raised = true;
    }
  }
  return is_raised;
}

}  // namespace twin::feedrate
