#include "feedrate/limits/chord_limit.hpp"

#include <cmath>
#include <limits>

namespace twin::feedrate {

double chord_error_feedrate(double curvature, double chord_error, double period) noexcept {
  if (!(curvature > 0.0) || curvature * chord_error >= 1.0) {
    return std::numeric_limits<double>::infinity();
  }
  return 2.0 / period * std::sqrt(chord_error * (2.0 / curvature - chord_error));
}

}  // namespace twin::feedrate
