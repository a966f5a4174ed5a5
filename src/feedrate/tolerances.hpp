#pragma once

/// Numerical tolerances of the planners, each with what it bounds. None of them is a limit of the
/// machine, and none moves a result by more than rounding: a plan of the same path drawn eight
/// times larger or smaller, with limits to match, takes the same time (tolerances_test.cpp).
namespace twin::feedrate {

/// Two places of the path closer than this are one place [mm].
///
/// Places are sums of segment lengths, so they carry rounding of some 1e-13 times the window's
/// length, far below it; a block of an NC program is at least 1e-4 mm, far above it. Ten times more
/// would merge nothing that a program can hold; ten times less would still be above the rounding of
/// a window of half a metre.
inline constexpr double kPlaceRounding = 1e-9;

/// A distance that a motion needs and one that it has are equal within this [mm].
///
/// It is of the size of kPlaceRounding, since distances are differences of places.
inline constexpr double kDistanceRounding = 1e-9;

/// A stop that would end this far beyond a place of rest ends there [mm].
///
/// A motion that follows phases of the plan ends where their sums do, some 1e-10 mm from the place
/// that was planned for; a hundredth of a nanometre is more than that, and as an acceleration it is
/// nothing: 0.01 mm/s^2 at a period of 1 ms.
inline constexpr double kRestRounding = 1e-8;

/// A stop that has come down to this feedrate is over [mm/s]. What it has left of its deceleration
/// is rounding, and it would not reach the end of a stretch in any time.
inline constexpr double kRestFeedrate = 1e-6;

/// How closely an ascent touches the corner of a limit [mm].
///
/// It is a tenth of kPlaceRounding, so that an ascent that touches is not seen as one that passes
/// through.
inline constexpr double kTouchRounding = 1e-10;

/// Two feedrates are equal if they differ by less than this share of the larger one [-].
///
/// It decides whether a motion is too fast for a zone. Ten times more would let a motion exceed a
/// limit by 2e-6 mm/s at 200 mm/s; ten times less is still above the rounding of the roots that the
/// motion is made of.
inline constexpr double kFeedrateRounding = 1e-9;

/// Two results of the same closed formula are equal within this share [-]: a feedrate that a phase
/// ends at and the limit that its end was computed from, or an acceleration and A.
///
/// It is some thousand times the rounding of a double, for a root of a difference loses a few
/// digits.
inline constexpr double kFormulaRounding = 1e-12;

/// A turn of the path smaller than this is none [rad].
///
/// Passed at 200 mm/s it changes the velocity by 2e-5 mm/s. The rounding of tangents is far below
/// it, and a corner ten times sharper still limits nothing.
inline constexpr double kNoTurn = 1e-7;

}  // namespace twin::feedrate
