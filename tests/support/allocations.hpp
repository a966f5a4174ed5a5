#pragma once

#include <cstdint>

namespace twin::test {

/// Calls of operator new in this process so far.
std::int64_t allocations() noexcept;
/// The same of this thread.
std::int64_t allocations_of_thread() noexcept;

}  // namespace twin::test
