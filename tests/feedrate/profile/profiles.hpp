#pragma once

#include <array>

#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate::testing {

inline constexpr std::array<AccelerationProfile, 3> kProfiles{
    AccelerationProfile::kTrapezoidal, AccelerationProfile::kSCurve, AccelerationProfile::kFir};

}  // namespace twin::feedrate::testing
