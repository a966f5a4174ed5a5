#pragma once

/// Numerical tolerances of the planners, each with what it bounds. None of them is a limit of the machine.
namespace twin::feedrate {

/// Two places of the path closer than this are one place [mm].
///
/// Places are sums of segment lengths, so they carry rounding of some 1e-13 times the window's length, far below it;
/// a block of an NC program is at least 1e-4 mm, far above it. Ten times more would merge nothing that a program can
/// hold; ten times less would still be above the rounding of a window of 10 m.
inline constexpr double kPlaceRounding = 1e-9;

/// A distance that a motion needs and one that it has are equal within this [mm].
///
/// It is of the size of kPlaceRounding, since distances are differences of places.
inline constexpr double kDistanceRounding = 1e-9;

/// How closely an ascent touches the corner of a limit [mm].
///
/// It is a tenth of kPlaceRounding, so that an ascent that touches is not seen as one that passes through.
inline constexpr double kTouchRounding = 1e-10;

/// Two feedrates are equal if they differ by less than this share of the larger one [-].
inline constexpr double kFeedrateRounding = 1e-9;

}  // namespace twin::feedrate
