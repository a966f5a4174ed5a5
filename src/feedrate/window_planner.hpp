#pragma once

#include <cstdint>
#include <vector>

#include "feedrate/limits/limit_zone.hpp"
#include "feedrate/paper/hump.hpp"
#include "feedrate/profile/phase.hpp"
#include "feedrate/profile/ramp_limits.hpp"

namespace twin::feedrate {

/// What a planner gets of the look-ahead's window, and what it settles of it.
struct Window {
  std::vector<LimitZone> zones;  ///< of the whole window, in path order
  Knot start;                    ///< up to where the feedrate is settled
  std::vector<Phase> phases;     ///< settled and not yet handed on
};

/// Way to plan the feedrate over a window and to settle the part that more segments would not
/// change.
class WindowPlanner {
 public:
  WindowPlanner() = default;
  WindowPlanner(const WindowPlanner&) = delete;
  WindowPlanner& operator=(const WindowPlanner&) = delete;
  virtual ~WindowPlanner() = default;

  /// Plans so that the path could end at rest at `last`, appends the settled phases and moves the
  /// start to their end.
  ///
  /// @param last     up to here all limits are final [mm]
  /// @param is_last  nothing follows: all is settled
  virtual void advance(Window& window, double last, bool is_last) = 0;

  /// Places are measured from a new start, that far from the old [mm].
  virtual void forget(double distance) = 0;

  /// How often a plan could not be made as wanted.
  std::int64_t fallbacks() const noexcept { return fallbacks_; }

 protected:
  std::int64_t fallbacks_ = 0;
};

/// Raises the limits after a start that is too fast for them so far that it can come down.
/// @returns false where that has been done already
bool raise_limits(Window& window, double last, const RampLimits& ramp);

}  // namespace twin::feedrate
