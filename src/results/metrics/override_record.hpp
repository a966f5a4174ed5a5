#pragma once

namespace twin::results {

/// A change of the feed override, times since the first set point.
struct OverrideRecord {
  double asked_at = 0.0;  ///< [s]
  double percent = 0.0;   ///< 0: feed hold [%]
  double from = 0.0;      ///< from when on the motion is another: a hold brakes then [s]
};

}  // namespace twin::results
