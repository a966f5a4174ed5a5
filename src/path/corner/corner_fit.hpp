#pragma once

#include <functional>
#include <optional>

#include "core/limits.hpp"
#include "core/vec.hpp"
#include "path/corner/corner_motion.hpp"
#include "path/corner/corner_table.hpp"

namespace twin::path {

/// A straight leg of a corner.
struct CornerLeg {
  Vec3 direction = Vec3::UnitX();  ///< of motion, unit vector
  double length = 0.0;             ///< [mm]
  double room = 0.0;               ///< what the corner at its other end has left of it [mm]
  double feedrate = 0.0;           ///< programmed [mm/s]
  double passage = 0.0;  ///< feedrate of the passage at its other end; 0: there is none [mm/s]
};

/// Most of a leg that a half passage may take up [-]. Two passages on one leg leave a tenth of it, so
/// that a stop has places where the feedrate can change. A larger share makes passages on short legs
/// faster, and stops longer.
inline constexpr double kMostOfLeg = 0.45;

/// Most of a leg that the feedrate of the leg may cover in the duration of a half passage [-]. So
/// passages on one leg have about one feedrate, whatever their turns, and there is room for the ramp
/// between them. A larger share leaves too little of it beside gentle turns, where the next passage
/// becomes much slower for it.
inline constexpr double kMostAtFeedrate = 0.55;

/// Most of a leg that a rounded corner may take up where a passage begins the leg [-]. The passage
/// leaves room for a stop before that, so that any feedrate can follow.
inline constexpr double kMostOfLegBesidePassage = 0.2;

/// The passage through a corner of two legs: the one of the highest feedrate that both legs have room
/// for. The feedrate is the same on both of them.
///
/// On either leg a passage leaves the room for a ramp from or to the passage at its other end, or from
/// or to rest. So every passage can be reached and left whatever follows.
///
/// With limits.jerk_of = path it keeps the jerk along the path, and those of the axes, all of which that
/// move must have one: without, the jerk across the path would have no bound.
///
/// @param curve      half width of the curve that could round the corner instead; 0: none [mm]
/// @param tolerance  [mm]
/// @param other      with jerk_of = path: time that the corner loses without a passage, beside a run of both
///                   legs at a feedrate
/// @returns nothing where there is no passage, or the curve loses less time under the same limits
std::optional<CornerMotion> fit_passage(const Vec3& corner, const CornerLeg& before,
                                        const CornerLeg& after, double tolerance, double curve,
                                        const Limits& limits, CornerTable& table,
                                        const std::function<double(double)>& other = {});

}  // namespace twin::path
