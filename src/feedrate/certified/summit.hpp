#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "feedrate/certified/rise.hpp"

namespace twin::feedrate {

/// The fastest motion between two anchors that first rises and then falls: the ascent from the one,
/// the ascent backward from the other, and what joins them.
///
///             ________  v
///            /        \.
///       ____/          \.
///   a  /                \___
///                           b
///
/// Both ascents are left by -J at the same feedrate v, and between them the feedrate is held. The
/// distance that an ascent needs to v grows with v, because p never falls along an ascent. So the
/// highest v for which both have room is the root of one equation of one unknown.
struct Summit {
  double v = 0.0;       ///< highest feedrate [mm/s]
  Rise::Exit up{};      ///< from the ascent
  Rise::Exit down{};    ///< from the backward ascent
  double length = 0.0;  ///< from anchor to anchor [mm]
};

/// Computes the next phase or phases of a rise.
/// @returns false where rounding leaves nothing that it could be extended by
bool extend(Rise& rise);

/// Joins two ascents whose anchors are `length` apart; extends them as far as is needed.
///
/// @param v_least  the higher of the two anchors' feedrates [mm/s]
/// @param cap      highest feedrate, >= v_least [mm/s]
/// @returns nothing where not even v_least leaves room
std::optional<Summit> join(Rise& up, Rise& down, double length, double v_least, double cap);

/// Appends the phases of a summit that begins at s0.
/// @returns index of the first phase of the descent
std::size_t append_phases(const Summit& summit, const Rise& up, const Rise& down, double s0,
                          std::vector<Phase>& phases);

}  // namespace twin::feedrate
