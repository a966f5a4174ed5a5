#pragma once

#include <string>

#include "core/error.hpp"
#include "hal/machine.hpp"

namespace twin::hal::rig {

/// What stands behind emulated cards, as far as a machine must know of it: how its time passes and
/// where the table truly is. Real cards have none.
class Bench {
 public:
  Bench() = default;
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;
  virtual ~Bench() = default;

  /// Power on: everything at rest, counters at 0. Not real-time safe.
  /// @param period  that advance() lets pass [s]
  virtual Expected<void> power_on(double period) = 0;
  /// True where time passes by itself, on the wall clock. Real-time safe.
  virtual bool keeps_own_time() const noexcept { return false; }
  /// Lets one period pass; does nothing where the bench keeps its own time. False: the simulation
  /// failed, last_error() says why. Real-time safe.
  virtual bool advance() noexcept = 0;
  /// True position of the table [mm], 0 where it stood at power on. Real-time safe.
  virtual Truth truth() const noexcept = 0;
  /// Where the pen slide, which has no wire, is to be [mm]. Real-time safe.
  virtual void set_pen_reference(double z) noexcept = 0;
  virtual std::string last_error() const = 0;
};

}  // namespace twin::hal::rig
