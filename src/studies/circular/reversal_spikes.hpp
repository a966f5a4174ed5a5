#pragma once

#include <array>
#include <span>

#include "core/vec.hpp"
#include "studies/circular/circle_program.hpp"

namespace twin::studies::circular {

/// What an axis leaves on the circle when it turns back.
struct Spike {
  double angle = 0.0;   ///< of its tip, from +X counter-clockwise [rad]
  double height = 0.0;  ///< of the tip over the path without spikes, positive outside [mm]
  double width = 0.0;   ///< at half the height [rad]
};

/// The spikes of one path.
struct ReversalSpikes {
  std::array<Spike, 4> quadrant;  ///< at 0 (X turns back), 90 (Y), 180 (X), 270 deg (Y)
  double ripple = 0.0;  ///< largest deviation away from the reversals; hides smaller spikes [mm]
};

/// How far behind a reversal its spike is looked for [rad]: the angle that passes in 50 ms, but at
/// least 15 deg and at most 45 deg.
/// @param angular_velocity  [rad/s]
double spike_reach(double angular_velocity);

/// Looks for the spike of each reversal.
///
/// The path without spikes is the least-squares fit of a constant and the first two harmonics to
/// the radius over the angle (size, centre, ellipse), away from the reversals. The tip is the
/// largest deviation from it between 2 deg before the reversal and `reach` behind it, in the
/// direction of motion.
///
/// @param path   one turn [mm], centre near (0, 0)
/// @param reach  0 < reach <= 45 deg [rad]
ReversalSpikes find_reversal_spikes(std::span<const Vec2> path, Sense sense, double reach);

}  // namespace twin::studies::circular
