#pragma once

#include <string>
#include <vector>

#include "core/wall_clock.hpp"

namespace twin::runtime {

/// Makes the calling thread a real-time thread, as far as the system lets it: SCHED_FIFO priority,
/// one CPU, memory locked, its stack touched beforehand.
///
/// Where the system refuses something, notes() says so, and the run goes on without it. The memory
/// is unlocked at the end.
class RealtimeThread {
 public:
  explicit RealtimeThread(const RealtimeSettings& settings);
  RealtimeThread(const RealtimeThread&) = delete;
  RealtimeThread& operator=(const RealtimeThread&) = delete;
  ~RealtimeThread();

  /// One line for everything that was wanted and not granted, with the reason.
  const std::vector<std::string>& notes() const noexcept { return notes_; }

 private:
  void lock_memory();
  void stay_on(int cpu);
  void set_priority(int priority);

  std::vector<std::string> notes_;
  bool has_locked_ = false;
};

}  // namespace twin::runtime
