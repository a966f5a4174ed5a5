#pragma once

#include <cstddef>
#include <vector>

#include "feedrate/limits/zones.hpp"
#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate {

/// Lowers the limit in the middle of lasting valleys, where that gains more on the ramps beside them
/// than it loses in them.
///
///   limit  ---.                     .---    V  lowest limit of the valley, w its width
///             |                     |       T  time of the rise within the valley, with a = 0 at its
///   V         |__                 __|          begin and J all along
///   feed      '. '.             .' .'
///               '. '._________.' .'
///                  '-----------'            V - J T^2 / 2
///
/// A valley that is held at V is entered and left without acceleration. One that is held a little lower is
/// entered with -J T and left with J T. With the feedrates F_1 and F_2 that are reached beside it, the time
/// lost beside running at them is
///   L(T) = l_1(v) + l_2(v) + (w - 2 h) (1 / v - 1 / F),   v = V - J T^2 / 2,   h = V T - J T^3 / 3,
///   l_i(v) = (F_i - v)^1.5 / (F_i sqrt(J)),
/// which falls at T = 0. Its minimum is found by steps of T. It counts where it is below the time lost with
/// the valley's own limits, however they change along it.
///
/// @param zones  of a curve, which all allow the acceleration and jerk of the machine
/// @param first  the first zone that may be changed
/// @param asked  feedrate asked for on the curve, and before and after it [mm/s]
void add_dips(std::vector<LimitZone>& zones, std::size_t first, double asked,
              const RampLimits& ramp);

}  // namespace twin::feedrate
