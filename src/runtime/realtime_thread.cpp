#include "runtime/realtime_thread.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace twin::runtime {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

/// Writes to each page of what the cycle may need of the stack, so that none is missing later.
void touch_stack() {
  constexpr std::size_t kBytes = 256 * 1024;
  constexpr std::size_t kPage = 4096;
  std::array<volatile unsigned char, kBytes> stack;
  for (std::size_t i = 0; i < kBytes; i += kPage) {
    stack[i] = 0;
  }
}

/// Whether memory that is allocated later may be locked too: with a limit an allocation beyond it
/// would fail.
bool may_lock_future() {
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  return limit.rlim_cur == RLIM_INFINITY || geteuid() == 0;
}

}  // namespace

RealtimeThread::RealtimeThread(const RealtimeSettings& settings) {
  if (settings.lock_memory) {
    lock_memory();
  }
  touch_stack();
  if (settings.cpu >= 0) {
    stay_on(settings.cpu);
  }
  if (settings.priority > 0) {
    set_priority(settings.priority);
  }
}

RealtimeThread::~RealtimeThread() {
  if (has_locked_) {
    munlockall();
  }
}

void RealtimeThread::lock_memory() {
  has_locked_ = mlockall(MCL_CURRENT | (may_lock_future() ? MCL_FUTURE : 0)) == 0;
  if (!has_locked_) {
    notes_.push_back(
        fmt::format("memory is not locked: {}; needs ulimit -l unlimited", reason(errno)));
  }
}

void RealtimeThread::stay_on(int cpu) {
  cpu_set_t cpus;
  CPU_ZERO(&cpus);
  CPU_SET(static_cast<std::size_t>(cpu), &cpus);
  if (const int error = pthread_setaffinity_np(pthread_self(), sizeof cpus, &cpus); error != 0) {
    notes_.push_back(fmt::format("the motion thread is not kept on CPU {}: {}; is there one?", cpu,
                                 reason(error)));
  }
}

void RealtimeThread::set_priority(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  if (const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
      error != 0) {
    notes_.push_back(fmt::format("no SCHED_FIFO priority {}: {}; needs ulimit -r or CAP_SYS_NICE",
                                 priority, reason(error)));
  }
}

}  // namespace twin::runtime
