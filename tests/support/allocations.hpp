#pragma once

#include <cstdint>

namespace twin::test {

/// Calls of operator new in this process so far.
std::int64_t allocations() noexcept;

}  // namespace twin::test
