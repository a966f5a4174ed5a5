#pragma once

#include "core/error.hpp"

namespace twin::hal::rig {

/// The guard over the outputs, as the machine sees it: a process of its own that makes the cards
/// safe when heartbeats stop. Where there is none (lockstep) the machine has a null pointer.
class Watch {
 public:
  Watch() = default;
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  virtual ~Watch() = default;

  /// From here on heartbeats are expected. Real-time safe.
  virtual void arm() noexcept = 0;
  /// A sign of life. Real-time safe.
  virtual void beat() noexcept = 0;
  /// Heartbeats are no longer expected: the outputs are safe. Real-time safe.
  virtual void disarm() noexcept = 0;
  /// The guard has made the outputs safe; nothing may be written to them any more. Real-time safe.
  virtual bool has_acted() const noexcept = 0;
  /// False once the guard itself is gone: nothing watches any more. Real-time safe.
  virtual bool is_alive() noexcept = 0;
};

}  // namespace twin::hal::rig
