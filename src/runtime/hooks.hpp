#pragma once

#include <cstdint>
#include <functional>

#include "hal/signals.hpp"

namespace twin::runtime {

/// What a motion looks out for: in the motion thread, after every period of the path. True for the
/// first time: it brakes on the path and ends as if that were the path's end. Real-time safe.
using Until = std::function<bool(const hal::Inputs&)>;

/// What tests put between the parts of a run to make it go wrong. Empty functions do nothing.
struct Hooks {
  /// In the motion thread, on the wall clock, after a period has begun; gets its number from 0.
  std::function<void(std::int64_t)> before_period;
  /// In the planning thread, before a segment is handed over; gets its number from 0.
  std::function<void(std::int64_t)> before_segment;
};

}  // namespace twin::runtime
