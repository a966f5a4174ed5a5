#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "hal/machine.hpp"
#include "hal/rig/io_port/io_port.hpp"
#include "hal/rig/rig_settings.hpp"
#include "hal/rig/servopack.hpp"

namespace twin::hal::rig {

inline constexpr std::size_t kDacs = 2;      ///< analogue outputs of the PCI-1716
inline constexpr std::size_t kCounters = 4;  ///< quadrature counters of the PCI-1784

/// What the cards show at one instant.
struct CardInputs {
  /// Unwrapped, since the cards were opened [counts].
  std::array<std::int64_t, kCounters> counts{};
  std::uint16_t digital = 0;    ///< DI 0 to 15 of the PCI-1716
  std::uint8_t index_seen = 0;  ///< bit i: counter i has met its index since the last read
};

/// What the cards are told.
struct CardOutputs {
  std::array<double, kDacs> volts{};  ///< [V], limited to what the converter can do
  std::uint16_t digital = 0;          ///< DO 0 to 15 of the PCI-1716
};

/// The two cards of the rig: analogue and digital lines of the PCI-1716, counters of the PCI-1784.
///
/// Two drivers: `RegisterCards` works the registers itself, `DaqnaviCards` goes through Advantech's
/// library. From construction on both analogue outputs are at 0 V and the digital outputs as
/// `safe_digital` has them; whatever ends the object leaves them so.
class Cards {
 public:
  Cards() = default;
  Cards(const Cards&) = delete;
  Cards& operator=(const Cards&) = delete;
  virtual ~Cards() = default;

  /// Latches all counters at one instant, then reads them and the inputs. Real-time safe.
  /// kError: a card no longer answers.
  virtual Status read(CardInputs& inputs) noexcept = 0;
  /// Digital outputs first, analogue outputs last. Real-time safe.
  virtual Status write(const CardOutputs& outputs) noexcept = 0;
  /// 0 V on both converters, then the digital outputs as `safe_digital` has them. Real-time safe,
  /// and safe in a signal handler.
  virtual void make_safe() noexcept = 0;
  /// Why a call returned kError; empty when none did. Not real-time safe.
  virtual std::string last_error() const = 0;
};

/// Finds and opens the cards with the driver that the settings name.
Expected<std::unique_ptr<Cards>> open_cards(const RigSettings& settings);

/// What the cards show to somebody who only looks.
struct RigView {
  int board_id_1716 = -1;  ///< -1: the card does not answer
  int board_id_1784 = -1;
  std::array<std::int64_t, kServoAxes> counts{};         ///< counter of each axis, raw [counts]
  std::uint16_t digital = 0;                             ///< DI 0 to 15
  std::array<DriveInputs, kServoAxes> drives{};          ///< what they mean
  std::array<std::optional<double>, kServoAxes> vref{};  ///< read back [V]; empty: not wired
};

/// Looks at both cards beside whatever drives them: latches the counters, converts the analogue
/// inputs that read V-REF back, writes no output and no mode. The converters' own registers cannot
/// be read. Not real-time safe.
RigView look_at_rig(io_port::IoPort& pci1716, io_port::IoPort& pci1784,
                    const RigSettings& settings);

}  // namespace twin::hal::rig
