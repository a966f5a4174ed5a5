#pragma once

#include <chrono>
#include <thread>

namespace twin::runtime {

/// A short sleep of a thread that looks for news of the motion thread, on the wall clock: there the
/// motion thread must not spend time on waking others.
inline void nap() { std::this_thread::sleep_for(std::chrono::microseconds(50)); }

}  // namespace twin::runtime
