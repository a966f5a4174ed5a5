#pragma once

#include <boost/lockfree/spsc_queue.hpp>
#include <functional>
#include <string_view>
#include <thread>

#include "hal/rig/emulator/event_log.hpp"

namespace twin::hal::rig::emulator {

/// Tells events line by line from a thread of its own, so that a slow terminal or disk does not
/// hold up the plant.
class EventTeller {
 public:
  /// @param tell  gets each line, without its end
  explicit EventTeller(const std::function<void(std::string_view)>& tell);
  /// Tells what is left.
  ~EventTeller() = default;

  /// Hands an event over. False: too many wait, this one is lost. Real-time safe.
  bool push(const Event& event) noexcept { return events_.push(event); }

 private:
  void tell_all();

  const std::function<void(std::string_view)>& tell_;
  boost::lockfree::spsc_queue<Event> events_{4096};
  std::jthread thread_;  // last: ends before what it uses
};

}  // namespace twin::hal::rig::emulator
