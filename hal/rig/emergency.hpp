#pragma once

#include "hal/rig/cards.hpp"

/// The last resort inside the process: outputs made safe from the handler of a fatal signal.
namespace twin::hal::rig {

/// Registers the cards that a fatal signal makes safe, for as long as it lives; one at a time.
class EmergencyStop {
 public:
  explicit EmergencyStop(Cards& cards) noexcept;
  EmergencyStop(const EmergencyStop&) = delete;
  EmergencyStop& operator=(const EmergencyStop&) = delete;
  ~EmergencyStop();
};

/// From here on SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT (assertions, uncaught exceptions), SIGSYS,
/// SIGTRAP, SIGXCPU and SIGQUIT make the registered cards safe before they end the process as
/// usual.
void install_emergency_handlers();

/// Makes the registered cards safe, if there are any; at most once. A signal handler may call it.
void make_registered_cards_safe() noexcept;

}  // namespace twin::hal::rig
