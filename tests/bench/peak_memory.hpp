#pragma once

#include <cstdint>

namespace twin::bench {

/// Forgets the peak of resident memory, so that peak_memory() counts from here on.
void reset_peak_memory();

/// Peak of the process's resident memory (VmHWM) [bytes].
std::int64_t peak_memory();

}  // namespace twin::bench
