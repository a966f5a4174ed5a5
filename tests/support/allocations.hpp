#pragma once

#include <cstdint>

namespace twin::hal::testing {

/// Calls of operator new in this process so far.
std::int64_t allocations() noexcept;

}  // namespace twin::hal::testing
