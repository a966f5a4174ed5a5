#include "hal/rig/emulator/event_teller.hpp"

#include <pthread.h>
#include <sched.h>

#include <chrono>
#include <stop_token>

namespace twin::hal::rig::emulator {

EventTeller::EventTeller(const std::function<void(std::string_view)>& tell)
    : tell_(tell), thread_([this](const std::stop_token& stop) {
        // The plant's thread may be a real-time one; this one need not.
        const sched_param ordinary{};
        pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
        while (!stop.stop_requested()) {
          tell_all();
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        tell_all();
      }) {}

void EventTeller::tell_all() {
  Event event;
  while (events_.pop(event)) {
    tell_(to_string(event));
  }
}

}  // namespace twin::hal::rig::emulator
