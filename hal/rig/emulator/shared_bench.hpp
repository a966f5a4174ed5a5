#pragma once

#include <memory>
#include <string>

#include "hal/rig/bench.hpp"
#include "hal/rig/boards/shared_registers.hpp"

namespace twin::hal::rig::emulator {

/// The bench of a controller whose emulator is another process: time passes there.
///
/// A real table never lags behind the clock; an emulator that the system held up does, until it has
/// caught up. advance() waits for that, at most kLongestWait, so that no command reaches the past.
///
/// An emulator that dies is not noticed here: its registers stay as it left them, as the wires of a
/// dead plant do. One that ends by itself takes its cards away, which the cards' driver sees.
class SharedBench final : public Bench {
 public:
  explicit SharedBench(std::shared_ptr<boards::SharedRegisters> shared) noexcept
      : shared_(std::move(shared)) {}

  /// The emulator has switched on already.
  Expected<void> power_on(double period) override;
  bool keeps_own_time() const noexcept override { return true; }
  bool advance() noexcept override;
  Truth truth() const noexcept override;
  void set_pen_reference(double z) noexcept override;
  std::string last_error() const override { return {}; }

 private:
  static constexpr std::int64_t kLongestWait = 10'000'000;  // [ns]

  std::shared_ptr<boards::SharedRegisters> shared_;
  std::int64_t given_up_at_ = -1;  // time of an emulator that did not catch up [ns]
};

}  // namespace twin::hal::rig::emulator
