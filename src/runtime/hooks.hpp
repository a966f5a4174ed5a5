#pragma once

#include <cstdint>
#include <functional>

namespace twin::runtime {

/// What tests put between the parts of a run to make it go wrong. Empty functions do nothing.
struct Hooks {
  /// In the motion thread, on the wall clock, after a period has begun; gets its number from 0.
  std::function<void(std::int64_t)> before_period;
  /// In the planning thread, before a segment is handed over; gets its number from 0.
  std::function<void(std::int64_t)> before_segment;
};

}  // namespace twin::runtime
