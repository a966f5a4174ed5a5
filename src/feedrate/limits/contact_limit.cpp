#include "feedrate/limits/contact_limit.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {

double contact_speed_feedrate(const LocalGeometry& at, double feedrate, double radius,
                              ToolSide side) noexcept {
  const double advance = at.level + (side == ToolSide::kLeft ? radius : -radius) * at.turning;
  if (advance == at.level || advance <= 0.0) {
    return feedrate;
  }
  const double climb = std::max(1.0 - at.level * at.level, 0.0);
  return feedrate / std::sqrt(advance * advance + climb);
}

}  // namespace twin::feedrate
