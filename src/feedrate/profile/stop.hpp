#pragma once

#include <limits>

#include "feedrate/profile/phases.hpp"
#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate {

/// A part of the path on which a plan keeps one acceleration A and one jerk J. The plan passes the
/// end of a stretch with no tangential acceleration, and its feedrate rises once and falls once at
/// most on the way there.
///
/// A stop that begins on the stretch rests at `rest` or before, as far as the plan was known when
/// the stretch became final: a later plan of what follows may leave less acceleration or jerk.
struct Stretch {
  double end = std::numeric_limits<double>::infinity();  ///< place where it ends [mm]
  RampLimits ramp;  ///< A and J, which every place of the stretch allows
  /// The next stretch allows no less than A and J, and is long enough to lose a deceleration A.
  bool is_harder_after = false;
  double rest = std::numeric_limits<double>::infinity();  ///< see below [mm]
};

/// The part of a stop that lies on one stretch.
struct StopPart {
  Brake brake;         ///< from its start to rest, or to the end of the stretch
  bool rests = false;  ///< it ends at rest; else it ends where the stretch does
};

/// The lowest motion from a place of a stretch on that can be gone on with after its end.
///
///   1. To rest with A and J (make_brake()), where the stretch is long enough.
///   2. Else, where the next stretch is harder and not too short, the same as far as the stretch
///      goes: there the next part begins with the deceleration at hand, which the next A allows.
///   3. Else as low as can be with no acceleration at the end, so that any A and J may follow.
///
/// From a motion of the plan, or from one that such parts have led to, each part has at every place
/// no more feedrate than the plan. So a stop of such parts keeps every limit of the feedrate that
/// the plan keeps, and the A and J of every stretch, whatever these are. For 1 and 2 this follows
/// from what make_brake() says. For 3, suppose that the part were faster than the plan somewhere.
/// It must have become so where it reduces its deceleration with J, at a place where both have one
/// feedrate and the plan has no less deceleration. From there on the plan, whose jerk is J at most,
/// is slower at every time up to the end of the part, where the part has a feedrate that is no
/// larger than the plan's at the stretch's end; but the plan falls up to there, so it is faster.
///
/// @param from  s is not beyond the end of the stretch
/// @note Real-time safe.
StopPart make_stop_part(const PathMotion& from, const Stretch& stretch) noexcept;

/// Lowers the feedrate within A and J so that after a distance there is no acceleration: the lowest
/// such feedrate. @param distance  shorter than that of the brake to rest [mm]
/// @note Real-time safe.
Brake make_slowdown(const PathMotion& from, const RampLimits& limits, double distance) noexcept;

/// Motion at the end of a brake.
PathMotion end_of(const Brake& brake) noexcept;

}  // namespace twin::feedrate
