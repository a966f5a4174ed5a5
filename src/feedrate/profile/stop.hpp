#pragma once

#include <limits>
#include <optional>

#include "feedrate/profile/phases.hpp"
#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate {

/// A part of the path on which a plan keeps one acceleration A and one jerk J. On the way to its end
/// the feedrate of the plan rises once and falls once at most.
///
/// A stop that begins on the stretch rests at `rest` or before, as far as the plan was known when
/// the stretch became final: a later plan of what follows may leave less acceleration or jerk.
struct Stretch {
  double end = std::numeric_limits<double>::infinity();  ///< place where it ends [mm]
  RampLimits ramp;    ///< A and J, which every place of the stretch allows
  double v = 0.0;     ///< feedrate of the plan at its end [mm/s]
  double fall = 0.0;  ///< deceleration of the plan at its end, over the square of its feedrate;
                      ///< 0 where it does not fall [1/mm]
  /// The next stretch allows no less than A and J, and is long enough to lose a deceleration A.
  bool is_harder_after = false;
  double rest = std::numeric_limits<double>::infinity();  ///< see above [mm]
  /// Above this feedrate the stretch is passed without acceleration: the passage of a corner [mm/s].
  double held_above = std::numeric_limits<double>::infinity();
};

/// The part of a stop that lies on one stretch.
struct StopPart {
  Brake brake;         ///< from its start to rest, or to the end of the stretch
  bool rests = false;  ///< it ends at rest; else it ends where the stretch does
};

/// The lowest motion from a place of a stretch on that can be gone on with after its end.
///
///   0. Where the feedrate is to be held, constant feedrate to the end of the stretch.
///   1. To rest with A and J (make_brake()), where the stretch is long enough.
///   2. Else, where the next stretch is harder and not too short, the same as far as the stretch
///      goes: there the next part begins with the deceleration at hand, which the next A allows.
///   3. Else, where the plan rises and the stretch is too short to lose its acceleration, -J.
///   4. Else as low as can be so that the end is passed as a slower run of the plan passes it
///      (make_slowdown()).
///   5. Where even that would rest with a deceleration, which the plan rules out but for rounding,
///      to rest with the least jerk that does.
///
/// Why there is always a next part. The plan, run x times as fast with x < 1, has the feedrate x v,
/// the acceleration x^2 a and the jerk x^3 j at each place. So it keeps all limits that the plan
/// keeps, and leads to rest where the plan does. Where the plan falls, a part ends on such a run. Where
/// it rises, a part ends without acceleration below the plan: that feedrate can be kept up to the
/// top of the plan, which is on such a run as well. With -J the acceleration is lost while the plan
/// still rises, since the plan keeps that way out open at every place (Rise).
///
/// Each part has at every place no more feedrate than the plan. For 1, 2 and 3 this follows from
/// what make_brake() says. For 4, suppose that the part were faster than the plan somewhere. It must
/// have become so where it reduces its deceleration with J, at a place where both have one feedrate
/// and the plan has no less deceleration. From there on the plan, whose jerk is J at most, is slower
/// at every time up to the end of the part, where the part has a feedrate that is no larger than the
/// plan's at the stretch's end; but the plan falls up to there, so it is faster.
///
/// @param from  s is not beyond the end of the stretch
/// @note Real-time safe.
StopPart make_stop_part(const PathMotion& from, const Stretch& stretch) noexcept;

/// Whether a deceleration can be lost with J before the feedrate is.
bool can_rest(const PathMotion& from, double jerk) noexcept;

/// Lowers the feedrate within A and J so that after a distance the deceleration is `fall` v^2, at
/// the lowest such feedrate v.
/// @param distance  shorter than that of the brake to rest [mm]
/// @param fall      >= 0 [1/mm]
/// @returns nothing where J is too little to lose the deceleration before the feedrate
/// @note Real-time safe.
std::optional<Brake> make_slowdown(const PathMotion& from, const RampLimits& limits,
                                   double distance, double fall) noexcept;

/// Motion at the end of a brake.
PathMotion end_of(const Brake& brake) noexcept;

}  // namespace twin::feedrate
