#pragma once

#include <chrono>
#include <functional>

#include "hal/rig/guard/guard_page.hpp"

namespace twin::hal::rig::guard {

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
