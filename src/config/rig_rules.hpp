#pragma once

#include "core/error.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::config {

/// Checks that no converter, counter, digital line or analogue input of the rig is used twice and
/// that the reset register is a whole one. @returns kFile error with the keys and the channel
Expected<void> check_rig_rules(const hal::rig::RigSettings& rig);

}  // namespace twin::config
