#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "core/error.hpp"
#include "hal/rig/guard/guard_protocol.hpp"
#include "hal/rig/rig_settings.hpp"

/// The guard's side: it opens the outputs of the rig and makes them safe when it must.
namespace twin::hal::rig::guard {

/// Opens the outputs of a rig a second time, beside the controller.
///
/// @param outputs  "sysfs:FILE" or "ioperm:BASE": the registers of the PCI-1716; "shared:NAME":
///                 those of an emulator's process; "daqnavi:LIBRARY:BOARD_ID": through Advantech's
///                 library
/// @param digital  digital outputs with the servos off
/// @returns what puts 0 V on both converters and then switches the servos off
Expected<std::function<void()>> open_guarded_outputs(const std::string& outputs, unsigned digital);

/// The guard's work: makes the outputs safe when an armed controller is gone or silent.
///
/// Looks once a millisecond. The controller is gone when the kernel says that the owner of the
/// page's mutex has died, which is the first thing it does when a process ends, however it ends; or
/// when the other end of the lifeline is closed, which may take as long as freeing its memory. It
/// is silent when it has not beaten for the timeout, in two looks in a row: where the whole system
/// stood still, the controller gets one turn to show that it goes on. Once it has acted it makes
/// the outputs safe again in every turn, so that a controller that wakes up in the middle of a
/// write cannot undo it. Returns when the lifeline is closed.
///
/// @param lifeline   read end of a pipe whose write end only the controller has
/// @param make_safe  0 V, then servo off
void run_guard(GuardPage& page, int lifeline, std::chrono::nanoseconds timeout,
               const std::function<void()>& make_safe);

}  // namespace twin::hal::rig::guard
