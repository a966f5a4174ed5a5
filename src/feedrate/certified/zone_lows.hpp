#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "feedrate/limits/zones.hpp"

namespace twin::feedrate {

/// Where zones have low limits, found without looking at each zone: the lowest limit of every
/// kBlock zones is known.
class ZoneLows {
 public:
  /// Takes the zones to search, which stay in place and unchanged as long as they are searched.
  void find(std::span<const LimitZone> zones);

  /// The first of the zones [from, last) whose limit is at most a feedrate; `last` if there is none.
  /// @param most  [mm/s]
  std::size_t next(std::size_t from, std::size_t last, double most) const noexcept;

  /// The zone of [first, last), which is not empty, with the lowest limit; of several, the one
  /// nearest to the middle, so that halves are left.
  std::size_t lowest(std::size_t first, std::size_t last) const noexcept;

 private:
  static constexpr std::size_t kBlock = 16;

  std::span<const LimitZone> zones_;
  std::vector<double> lows_;  // of each block [mm/s]
};

}  // namespace twin::feedrate
