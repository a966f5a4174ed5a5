#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hal/dac.hpp"
#include "hal/rig/cards.hpp"
#include "hal/rig/io_port/io_port.hpp"

namespace twin::hal::rig {

/// Code of 0 V in the +-10 V range; code 0 would be -10 V.
inline constexpr std::uint16_t kZeroVolts = 0x8000;

/// Puts both converters of a PCI-1716 at 0 V, then the digital outputs as given.
///
/// Order of writes: the code of 0 V to both data registers, the range word (+-10 V), the codes of
/// 0 V again, and the digital outputs. The order matters because a code that means 0 V in one range
/// means a voltage in another: code 0 is 0 V in a unipolar range and -10 V in the range used here.
/// Driver, guard and signal handlers share this function. It may be called at any time, and in a
/// signal handler if the functions of the port may be.
void make_safe(io_port::IoPort& pci1716, std::uint16_t digital) noexcept;

/// Advantech PCI-1716: two 16 bit D/A converters, 16 digital inputs and outputs, A/D converter.
///
/// Register map (BAR 2) as in Linux-Comedi's adv_pci1710 and Advantech's own driver of 2006. The
/// converters are used at +-10 V, in offset binary:
///   code = clamp(round(V / 10 V 2^15) + 2^15, 0, 2^16 - 1).
/// Registers are accessed 16 bits wide: a wider write at 0x0A or 0x0C would reach the next one.
class Pci1716 {
 public:
  /// Range of an analogue input, by its code in the gain register; bipolar, single ended.
  enum class InputRange : std::uint16_t { k5V = 0x00, k2V5 = 0x01, k1V25 = 0x02, k10V = 0x04 };

  /// Touches nothing. The port must outlive this.
  /// @param safe_digital  digital outputs with every drive off
  Pci1716(io_port::IoPort& port, std::uint16_t safe_digital) noexcept;

  /// Drives off, then 0 V at +-10 V. Real-time safe.
  void open() noexcept;
  /// 0 V, then drives off. Real-time safe, and safe in a signal handler where the port is.
  void make_safe() noexcept;

  /// Sets a converter. A voltage out of range is clamped, and not-a-number is taken as 0 V.
  /// Real-time safe.
  /// @param channel  0 or 1
  void set_volts(std::size_t channel, double volts) noexcept;
  /// Sets the digital outputs; writes only where they change. Real-time safe.
  void set_digital(std::uint16_t levels) noexcept;
  /// Digital outputs as last written.
  std::uint16_t digital_out() const noexcept {
    return digital_out_.load(std::memory_order_relaxed);
  }

  /// Digital inputs. Real-time safe.
  std::uint16_t digital_in() noexcept;
  /// Converts one analogue input by software trigger, and polls for the result with at most about
  /// 100 accesses. Real-time safe.
  /// @param channel  0 to 15
  /// @returns [V], or nothing if the converter did not answer
  std::optional<double> read_volts(int channel, InputRange range = InputRange::k10V) noexcept;
  /// Board ID switch, 0 to 15; -1 if the card does not answer. Real-time safe.
  int board_id() noexcept;
  /// True if the card no longer answers. Board ID and A/D status then read as all ones, which no
  /// card shows, since its FIFO would be empty and full at the same time. Real-time safe.
  bool is_gone() noexcept;

 private:
  io_port::IoPort& port_;
  Dac dac_{16};
  std::uint16_t safe_digital_;
  std::atomic<std::uint16_t> digital_out_;  // what the write-only register holds
};

}  // namespace twin::hal::rig
