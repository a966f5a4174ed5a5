#include "hal/rig/emergency.hpp"

#include <signal.h>

#include <array>
#include <atomic>

namespace twin::hal::rig {
namespace {

constexpr std::array kFatal{SIGSEGV, SIGBUS,  SIGFPE,  SIGILL, SIGABRT,
                            SIGSYS,  SIGTRAP, SIGXCPU, SIGQUIT};

std::atomic<Cards*> registered{nullptr};
alignas(16) std::array<char, 65536> handler_stack;  // a stack that overflowed cannot run a handler
std::array<struct sigaction, kFatal.size()> previous;

/// Hands the signal on to whatever handled it before: the end of the process, or a sanitizer's
/// report and then that.
extern "C" void stop_and_die(int signal) {
  make_registered_cards_safe();
  for (std::size_t i = 0; i < kFatal.size(); ++i) {
    if (kFatal[i] == signal) {
      sigaction(signal, &previous[i], nullptr);
    }
  }
  raise(signal);
}

}  // namespace

EmergencyStop::EmergencyStop(Cards& cards) noexcept { registered = &cards; }

EmergencyStop::~EmergencyStop() { registered = nullptr; }

void make_registered_cards_safe() noexcept {
  if (Cards* const cards = registered.exchange(nullptr)) {
    cards->make_safe();
  }
}

void install_emergency_handlers() {
  static const bool is_installed = [] {
    stack_t stack{};
    stack.ss_sp = handler_stack.data();
    stack.ss_size = handler_stack.size();
    sigaltstack(&stack, nullptr);
    struct sigaction action {};
    action.sa_handler = stop_and_die;
    action.sa_flags = static_cast<int>(SA_ONSTACK | SA_NODEFER);
    for (std::size_t i = 0; i < kFatal.size(); ++i) {
      sigaction(kFatal[i], &action, &previous[i]);
    }
    return true;
  }();
  static_cast<void>(is_installed);
}

}  // namespace twin::hal::rig
