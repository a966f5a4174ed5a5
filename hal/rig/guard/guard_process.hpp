#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "hal/rig/guard/guard_protocol.hpp"
#include "hal/rig/guard/heartbeat_timer.hpp"
#include "hal/rig/watch.hpp"

namespace twin::hal::rig::guard {

/// What the guard must know to make the outputs safe without the controller.
struct GuardTarget {
  std::filesystem::path program;          ///< the guard, twin-guard
  std::string outputs;                    ///< text of the port of the PCI-1716, or of the library
  unsigned safe_digital = 0;              ///< digital outputs with the servos off
  std::chrono::milliseconds timeout{20};  ///< without a heartbeat
};

/// The guard in a process of its own, and the controller's hold on it.
///
/// The guard has the card open by itself, is in a session of its own and ignores what a terminal
/// sends, so that it outlives the controller whatever ends that. Until it is started this does
/// nothing.
class GuardProcess final : public Watch {
 public:
  GuardProcess() = default;
  /// Disarms and ends it.
  ~GuardProcess() override;

  /// Starts it and waits until it has the card; nothing where it runs already. Not real-time safe.
  Expected<void> start(const GuardTarget& target);

  void arm() noexcept override;
  void beat() noexcept override;
  void disarm() noexcept override;
  bool has_acted() const noexcept override;
  /// False once the guard's own loop has stood still for a second: it was killed.
  bool is_alive() noexcept override;

  pid_t pid() const noexcept { return pid_; }

 private:
  Expected<void> spawn(const GuardTarget& target);
  Expected<void> wait_until_watching();
  void end() noexcept;

  GuardPage* page_ = nullptr;
  int lifeline_ = -1;  // write end
  pid_t pid_ = -1;
  HeartbeatTimer guard_timer_{std::chrono::seconds(1)};
};

}  // namespace twin::hal::rig::guard
