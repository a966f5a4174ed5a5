#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/error.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig::guard {

/// Opens the outputs of a rig a second time, beside the controller.
///
/// @param outputs  "sysfs:FILE" or "ioperm:BASE": the registers of the PCI-1716; "shared:NAME":
///                 those of an emulator's process; "daqnavi:LIBRARY:BOARD_ID": through Advantech's
///                 library
/// @param digital  digital outputs with the servos off
/// @returns what puts 0 V on both converters and then switches the servos off
Expected<std::function<void()>> open_guarded_outputs(const std::string& outputs, unsigned digital);

}  // namespace twin::hal::rig::guard
