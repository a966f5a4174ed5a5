#pragma once

#include <vector>

#include "nc_programs/generate/fair_curve.hpp"

namespace twin::programs {

/// Shape of the rounds.
struct RoundShape {
  double peak = 1.05;  ///< largest curvature [1/mm]
  /// Length d over which the curvature rises to it and falls again [mm]; less at a corner of few
  /// degrees.
  double transition = 1.0;
};

/// Round of a corner between two curves, with continuous curvature.
///
/// Along its length l the round has the curvature
///   kappa(u) = (1 - w(u)) ((1 - q) kappa_a + q kappa_b) + w(u) (+-peak),  q = S(u/l),
/// with kappa_a and kappa_b those of the two curves where it leaves and meets them, S the smooth
/// step 6 x^5 - 15 x^4 + 10 x^3 and the window w(u) = S(u/d) rising, 1 on top and S((l-u)/d)
/// falling over the transition d. Heading and place follow by integration; the parameters t_a and
/// t_b at which the round leaves the first curve and meets the second, and l, are solved by
/// Newton's method from "end point and end heading fit".
struct Round {
  double leave;               ///< t_a on the curve before
  double meet;                ///< t_b on the curve after
  double length;              ///< l [mm]
  std::vector<Frame> frames;  ///< equally spaced along the round, both ends included
};

/// Round between the end of `before` and the start of `after`.
/// @throws std::runtime_error if no such round fits (a corner too shallow or curves too short)
Round round_corner(const FairCurve& before, const FairCurve& after, const RoundShape& shape);

}  // namespace twin::programs
