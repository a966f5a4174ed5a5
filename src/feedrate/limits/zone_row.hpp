#pragma once

#include <vector>

#include "feedrate/limits/limit_zone.hpp"

namespace twin::feedrate {

/// Appends the zones of one segment in a row; neighbours whose limits differ by less than 1 %
/// become one zone, with the lowest limits of all of them.
class ZoneRow {
 public:
  /// @param zones  get the zones; those that are there already stay as they are
  explicit ZoneRow(std::vector<LimitZone>& zones) : zones_(zones), first_(zones.size()) {}

  /// Appends a zone that begins where the last one ends, or widens that one.
  void append(const LimitZone& zone);

  bool is_empty() const noexcept { return zones_.size() == first_; }
  LimitZone& last() noexcept { return zones_.back(); }

  /// Lowers the limit of the last zone, and of what it is made of [mm/s].
  void lower_last(double limit) noexcept;

 private:
  std::vector<LimitZone>& zones_;
  std::size_t first_;
  double highest_ = 0.0;  // limit of the zones that became the last one [mm/s]
};

}  // namespace twin::feedrate
