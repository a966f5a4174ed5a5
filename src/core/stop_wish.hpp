#pragma once

#include <atomic>

#include "core/error.hpp"

namespace twin {

/// An error of kInterrupted once the flag of whoever wants to end is set.
///
/// @param stop     may be null: nobody wants to
/// @param message  what the end leaves behind, as in "interrupted: nothing has moved"
inline Expected<void> check_wish(const std::atomic<bool>* stop, const char* message) {
  return stop != nullptr && stop->load(std::memory_order_relaxed)
             ? Expected<void>(fail(ErrorCode::kInterrupted, message))
             : Expected<void>();
}

}  // namespace twin
