#pragma once

#include <random>
#include <vector>

#include "feedrate/limits/zones.hpp"
#include "feedrate/profile/ramps.hpp"
#include "tests/support/motion_profile.hpp"

namespace twin::test {

/// Zones of all sizes, with single places and stops between them.
std::vector<feedrate::LimitZone> random_zones(std::mt19937& random);

/// Fails unless the feedrate stays under every zone, but for the rounding of places.
void expect_under_zones(const MotionProfile& profile,
                        const std::vector<feedrate::LimitZone>& zones);

/// Fails unless the phases join in place, feedrate and acceleration and keep A and J.
void expect_feasible(const MotionProfile& profile, const feedrate::RampLimits& limits);

}  // namespace twin::test
