#pragma once

#include <atomic>

namespace twin {

/// While one lives, the process must come to its own end: a machine is on, or a file is being
/// closed.
///
/// Whoever ends the process because its user asked for it waits until there is none. Every other
/// moment is one at which the process may be cut off, because files have their names only when they
/// are whole.
class MustFinish {
 public:
  MustFinish() noexcept { ++count_; }
  MustFinish(const MustFinish&) noexcept : MustFinish() {}
  MustFinish& operator=(const MustFinish&) noexcept { return *this; }
  ~MustFinish() { --count_; }

  /// Whether there is one, in any thread.
  static bool is_any() noexcept { return count_.load() > 0; }

 private:
  inline static std::atomic<int> count_{0};
};

}  // namespace twin
