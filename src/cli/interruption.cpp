#include "cli/interruption.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <system_error>
#include <thread>

#include "cli/terminal.hpp"
#include "core/must_finish.hpp"
#include "core/temporary_name.hpp"
#include "hal/rig/emergency.hpp"
#include "operator/terminal.hpp"

namespace twin::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kGrace = 80ms;      // for what looks at the flag to end by itself
constexpr auto kGlance = 5ms;      // between two looks at what must finish
constexpr int kInterrupted = 130;  // exit status, as a shell gives it after Ctrl-C

std::atomic<bool> stop_requested{false};
std::atomic<bool> is_ending{false};  // whoever sets it ends the program
int wake_up = -1;                    // an eventfd, written before the handler is put in place

extern "C" void request_stop(int signal) {
  if (stop_requested.exchange(true)) {
    hal::rig::make_registered_cards_safe();
    operator_station::RawTerminal::restore();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  const int reason = errno;
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake_up, &one, sizeof(one));
  errno = reason;
}

/// Waits until nothing has had to finish for a while.
void wait_for_grace() {
  using Clock = std::chrono::steady_clock;
  for (auto end = Clock::now() + kGrace; Clock::now() < end;) {
    std::this_thread::sleep_for(kGlance);
    if (MustFinish::is_any()) {
      end = Clock::now() + kGrace;
    }
  }
}

/// Body of the watching thread.
void cut_off_when_asked() {
  std::uint64_t count = 0;
  while (::read(wake_up, &count, sizeof(count)) < 0 && errno == EINTR) {
  }
  wait_for_grace();
  if (is_ending.exchange(true)) {
    return;
  }
  TemporaryName::remove_all();
  operator_station::RawTerminal::restore();
  print_error("interrupted");
  ::_exit(kInterrupted);
}

}  // namespace

void watch_signals() {
  wake_up = ::eventfd(0, EFD_CLOEXEC);
  if (wake_up < 0) {
    throw std::system_error(errno, std::generic_category(), "cannot watch for signals");
  }
  // The thread gets no signals, so that a blocking call of the command's own thread returns.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread(cut_off_when_asked).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (signal == SIGHUP && action.sa_handler == SIG_IGN) {
      continue;
    }
    action = {};
    action.sa_handler = request_stop;
    sigaction(signal, &action, nullptr);
  }
}

const std::atomic<bool>& stop_flag() noexcept { return stop_requested; }

void keep_from_being_cut_off() {
  while (is_ending.exchange(true)) {
    ::pause();  // until the other thread ends the program
  }
}

}  // namespace twin::cli
