#pragma once

#include "core/error.hpp"
#include "core/must_finish.hpp"
#include "hal/machine.hpp"

namespace twin::hal {

/// Configures and activates a machine; whatever happens, it is left with 0 V and servo off.
class ActiveMachine {
 public:
  explicit ActiveMachine(Machine* machine) : machine_(machine) {}
  ActiveMachine(const ActiveMachine&) = delete;
  ActiveMachine& operator=(const ActiveMachine&) = delete;
  ~ActiveMachine() {
    if (machine_ != nullptr) {
      machine_->deactivate();
      machine_->cleanup();
    }
  }
  Expected<void> start(double period) {
    if (machine_ == nullptr) {
      return {};
    }
    TWIN_CHECK(checked(machine_->configure(period)));
    return checked(machine_->activate());
  }

 private:
  MustFinish finish_;
  Machine* machine_;
};

}  // namespace twin::hal
