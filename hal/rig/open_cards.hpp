#pragma once

#include <memory>

#include "hal/rig/cards.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig {

/// Finds and opens the cards with the driver that the settings name.
Expected<std::unique_ptr<Cards>> open_cards(const RigSettings& settings);

}  // namespace twin::hal::rig
