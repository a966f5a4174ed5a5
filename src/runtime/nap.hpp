#pragma once

#include <chrono>
#include <thread>

namespace twin::runtime {

/// A short wait for another thread.
inline void nap() { std::this_thread::sleep_for(std::chrono::microseconds(20)); }

}  // namespace twin::runtime
