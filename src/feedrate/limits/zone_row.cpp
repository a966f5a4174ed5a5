#include "feedrate/limits/zone_row.hpp"

#include <algorithm>

namespace twin::feedrate {
namespace {

constexpr double kSameLimit = 1.01;  // ratio of limits that share a zone

}  // namespace

void ZoneRow::append(const LimitZone& zone) {
  if (!is_empty()) {
    LimitZone& before = zones_.back();
    const double low = std::min(before.limit, zone.limit);
    if (std::max(highest_, zone.limit) <= kSameLimit * low) {
      highest_ = std::max(highest_, zone.limit);
      before.limit = low;
      before.end = zone.end;
      before.acceleration = std::min(before.acceleration, zone.acceleration);
      before.jerk = std::min(before.jerk, zone.jerk);
      return;
    }
  }
  highest_ = zone.limit;
  zones_.push_back(zone);
}

void ZoneRow::lower_last(double limit) noexcept { highest_ = zones_.back().limit = limit; }

}  // namespace twin::feedrate
