#pragma once

#include <memory>
#include <string>

#include "hal/rig/bench.hpp"
#include "hal/rig/boards/shared_registers.hpp"

namespace twin::hal::rig {

/// The bench of a controller whose emulator is another process: time passes there.
///
/// An emulator that dies is not noticed here: its registers stay as it left them, as the wires of a
/// dead plant do. One that ends by itself takes its cards away, which the cards' driver sees.
class SharedBench final : public Bench {
 public:
  explicit SharedBench(std::shared_ptr<SharedRegisters> shared) noexcept
      : shared_(std::move(shared)) {}

  /// The emulator has switched on already.
  Expected<void> power_on(double period) override;
  bool keeps_own_time() const noexcept override { return true; }
  bool advance() noexcept override { return true; }
  Truth truth() const noexcept override;
  void set_pen_reference(double z) noexcept override;
  std::string last_error() const override { return {}; }

 private:
  std::shared_ptr<SharedRegisters> shared_;
};

}  // namespace twin::hal::rig
