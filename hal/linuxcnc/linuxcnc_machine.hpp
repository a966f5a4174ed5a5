#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "hal/linuxcnc/shared_segment.hpp"
#include "hal/machine.hpp"

namespace twin::hal::linuxcnc {

/// Scales of the machine behind LinuxCNC's HAL, signed.
struct Scales {
  std::array<double, kServoAxes> mm_per_count{};       ///< encoder [mm/count]
  std::array<double, kServoAxes> mm_per_s_per_volt{};  ///< V-REF [mm/s/V]
};

/// What the pins twinctl.feed-hold and twinctl.feed-override ask for.
struct FeedWish {
  bool is_held = false;
  double percent = 100.0;  ///< of the programmed feedrate [%]

  bool operator==(const FeedWish&) const = default;
};

/// A machine that LinuxCNC's HAL drives, through its component `twinctl`.
///
///   HAL pins -> twinctl.read -> read() ... write() -> twinctl.write -> HAL pins
///
/// LinuxCNC's servo thread gives the beat: read() waits for its next period. An answer that comes
/// after the component's deadline holds the outputs for hold-periods; then the component switches
/// off by itself, as it does when this process is gone, so that nothing here can keep an axis
/// moving.
class LinuxCncMachine final : public Machine {
 public:
  /// @param name  of the shared memory; empty: default_segment_name()
  LinuxCncMachine(const Scales& scales, std::string name);
  ~LinuxCncMachine() override;

  const MachineInfo& info() const noexcept override { return info_; }
  std::optional<Error> configure(double period) override;
  std::optional<Error> activate() override;
  Status read(Inputs& inputs) noexcept override;
  Status write(const Outputs& outputs) noexcept override;
  Truth truth() const noexcept override { return {}; }
  void deactivate() noexcept override;
  void cleanup() noexcept override;
  std::string last_error() const override;

  /// As of the last read(). For any thread.
  FeedWish feed_wish() const noexcept { return {is_feed_held_.load(), feed_percent_.load()}; }

 private:
  enum class Fault {
    kNone,
    kNotConfigured,  // read() came before configure()
    kNotActive,      // write() came before activate()
    kNotANumber,     // in the outputs
    kGone,           // the component is
    kStands,         // the servo thread does
    kSwitchedOff,    // the component has made the outputs safe
    kEmergencyStop,
  };

  Expected<void> check_thread(double period);
  Expected<void> check_wires() const;
  Expected<void> get_ready();
  Expected<void> wait_for_standstill();
  bool wait_for_beat() noexcept;
  std::int64_t counts(std::size_t axis) const noexcept;
  void fill(Inputs& inputs) noexcept;
  void command_nothing() noexcept;
  Status stop_with(Fault fault) noexcept;

  std::string name_;
  MachineInfo info_;
  State state_ = State::kUnconfigured;
  Fault fault_ = Fault::kNone;
  std::unique_ptr<SharedSegment> shared_;
  std::array<std::size_t, kServoAxes> place_{};          // of x and y among the component's axes
  std::array<std::int64_t, kServoAxes> origin_{};        // set by activate() [counts]
  std::array<std::uint32_t, kServoAxes> index_marks_{};  // as last read
  std::array<bool, kServoAxes> servo_on_{};              // as last written
  std::uint64_t periods_ = 0;                            // of the thread, as last read
  std::atomic<bool> is_feed_held_{false};
  std::atomic<double> feed_percent_{100.0};  // [%]
  bool is_driving_ = false;  // the component waits for answers: from the first write() on
};

}  // namespace twin::hal::linuxcnc
