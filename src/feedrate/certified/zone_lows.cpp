#include "feedrate/certified/zone_lows.hpp"

#include <algorithm>
#include <limits>

namespace twin::feedrate {

void ZoneLows::find(std::span<const LimitZone> zones) {
  zones_ = zones;
  lows_.assign((zones.size() + kBlock - 1) / kBlock, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < zones.size(); ++i) {
    lows_[i / kBlock] = std::min(lows_[i / kBlock], zones[i].limit);
  }
}

std::size_t ZoneLows::next(std::size_t from, std::size_t last, double most) const noexcept {
  std::size_t i = from;
  while (i < last) {
    if (lows_[i / kBlock] > most) {
      i = (i / kBlock + 1) * kBlock;
    } else if (zones_[i].limit <= most) {
      return i;
    } else {
      ++i;
    }
  }
  return last;
}

std::size_t ZoneLows::lowest(std::size_t first, std::size_t last) const noexcept {
  const std::size_t middle = first + (last - first) / 2;
  const auto off = [&](std::size_t i) { return i > middle ? i - middle : middle - i; };
  std::size_t lowest = first;
  for (std::size_t i = first; i < last; i = next(i + 1, last, zones_[lowest].limit)) {
    if (zones_[i].limit < zones_[lowest].limit || off(i) < off(lowest)) {
      lowest = i;
    }
  }
  return lowest;
}

}  // namespace twin::feedrate
