#pragma once

#include <atomic>

namespace twin::hal::rig::io_port {

/// The first errno of a port; a later one changes nothing. Lock-free, so that a signal handler may
/// use the port.
class PortError {
 public:
  void note(int number) noexcept {
    int none = 0;
    first_.compare_exchange_strong(none, number, std::memory_order_relaxed);
  }
  int first() const noexcept { return first_.load(std::memory_order_relaxed); }

 private:
  std::atomic<int> first_{0};
};

}  // namespace twin::hal::rig::io_port
