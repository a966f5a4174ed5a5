#pragma once

#include <vector>

#include "nc_programs/generate/outline.hpp"

namespace twin::programs {

/// What the chords of a linearised outline must come to.
struct ChordTarget {
  int blocks;       ///< number of chords
  double shortest;  ///< [mm]
  double longest;   ///< [mm]
};

/// Points of a closed outline, first and last the same.
struct Chords {
  std::vector<Point2> points;  ///< [mm], blocks + 1 of them
  double tolerance;            ///< chord tolerance e that gave the wanted number of chords [mm]
};

/// Linearises an outline with chords that follow its curvature.
///
/// A chord of length L on a circle of curvature kappa has the sagitta L^2 kappa / 8, so a chord
/// tolerance e asks for
///   L(s) = clamp(sqrt(8 e / |kappa(s)|), shortest, longest),
/// here with its slope held to |dL/ds| <= kSlope so that neighbours differ little. The points lie
/// where
///   n(s) = integral ds / L(s)
/// counts up by one from the start; e is found by bisection so that n once around is the wanted
/// number. No chord is left over at the closing point.
/// @param start  arc length of the first point [mm]
/// @throws std::runtime_error if no e gives the wanted number within the shortest and longest chord
Chords linearise(const Outline& outline, const ChordTarget& target, double start);

}  // namespace twin::programs
