#pragma once

#include <cstdint>

#include "core/error.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig {

/// True if a drive has an alarm (or its wire is broken).
bool has_alarm(const RigSettings& settings, std::uint16_t inputs) noexcept;

/// Checks what the drives say before they are switched on.
///
/// Refused are a drive with an alarm, and an axis at both its limits at once: no table can be, so
/// the cable to that drive is off.
/// @param inputs  digital inputs of the PCI-1716
/// @returns a kMachine error that names axis, signal, channel and level
Expected<void> check_drives(const RigSettings& settings, std::uint16_t inputs);

}  // namespace twin::hal::rig
