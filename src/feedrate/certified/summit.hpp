#pragma once

#include <cstddef>
#include <vector>

#include "feedrate/certified/ascent.hpp"

namespace twin::feedrate {

/// The fastest motion between two knots that rises first and falls then: the ascent from one, the
/// ascent backward from the other, and what joins them.
///
///             ________  v      Both ascents are left by -J at the same feedrate v, the highest for
///            /        \.       which they leave room to each other; between them the feedrate is
///       ____/          \.      held. p never falls along an ascent, so the distance to v grows
///   a  /                \___   with v, and v is the root of one equation.
///                           b
struct Summit {
  double v = 0.0;       ///< highest feedrate [mm/s]
  Ascent::Exit up{};    ///< from the ascent
  Ascent::Exit down{};  ///< from the backward ascent
  double length = 0.0;  ///< from knot to knot [mm]
};

/// Joins two ascents that are `length` apart; extends them as far as is needed.
///
/// @param v_least  the higher of the two knots' feedrates [mm/s]
/// @param cap      highest feedrate, >= v_least [mm/s]
/// @returns false where not even v_least leaves room
bool join(Ascent& up, Ascent& down, double length, double v_least, double cap, Summit& summit);

/// Appends the phases of a summit that begins at s0. The jerk is stretched by rounding alone.
/// @returns index of the first phase of the descent
std::size_t append_phases(const Summit& summit, const Ascent& up, const Ascent& down, double s0,
                          double jerk, std::vector<Phase>& phases);

}  // namespace twin::feedrate
