#include "operator/terminal.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>

namespace twin::operator_station {
namespace {

// What a signal handler needs: written before it is put in place.
termios before{};
std::atomic<bool> is_changed{false};

constexpr std::array kFatal{SIGQUIT, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
std::array<struct sigaction, kFatal.size()> handlers{};

/// Puts the terminal back and leaves the rest to whoever handled the signal before.
extern "C" void restore_and_pass_on(int signal) {
  RawTerminal::restore();
  for (std::size_t i = 0; i < kFatal.size(); ++i) {
    if (kFatal[i] == signal) {
      sigaction(signal, &handlers[i], nullptr);
    }
  }
  std::raise(signal);
}

}  // namespace

RawTerminal::RawTerminal() {
  if (isatty(STDIN_FILENO) != 1 || tcgetpgrp(STDIN_FILENO) != getpgrp() ||
      tcgetattr(STDIN_FILENO, &before) != 0) {
    return;
  }
  termios raw = before;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  raw.c_cc[VSUSP] = _POSIX_VDISABLE;
  is_changed = true;
  for (std::size_t i = 0; i < kFatal.size(); ++i) {
    struct sigaction action {};
    action.sa_handler = restore_and_pass_on;
    sigaction(kFatal[i], &action, &handlers[i]);
  }
  is_raw_ = tcsetattr(STDIN_FILENO, TCSANOW, &raw) == 0;
}

RawTerminal::~RawTerminal() {
  if (is_changed) {
    restore();
    for (std::size_t i = 0; i < kFatal.size(); ++i) {
      sigaction(kFatal[i], &handlers[i], nullptr);
    }
  }
}

void RawTerminal::restore() noexcept {
  if (is_changed.exchange(false)) {
    tcsetattr(STDIN_FILENO, TCSANOW, &before);
  }
}

}  // namespace twin::operator_station
