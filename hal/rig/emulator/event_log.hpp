#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace twin::hal::rig::emulator {

/// What an emulated rig has to tell. In brackets: the channel or axis, and the value.
enum class EventKind : std::uint8_t {
  kDacDriven,         ///< a converter leaves 0x8000 [DAC, code]
  kDacAtZero,         ///< a converter came to 0x8000 and stayed for kRestTime [DAC, code]
  kDigitalOut,        ///< the digital outputs changed [-, word]
  kServoReady,        ///< [axis]
  kServoOff,          ///< /S-RDY off [axis]
  kAlarm,             ///< [axis]
  kAlarmCleared,      ///< [axis]
  kLimitPositive,     ///< P-OT [axis, 1 open, 0 closed again]
  kLimitNegative,     ///< N-OT [axis, 1 open, 0 closed again]
  kFault,             ///< a fault was injected [axis, FaultKind]
  kControllerJoined,  ///< [-, process]
  kControllerLeft,    ///< it said so [-, process]
  kControllerDied,    ///< it ended without saying so [-, process]
  kFellBehind,        ///< the wall clock ran away [-, ms left out]
};

/// At 0x8000 for so long counts as rest [s]. A servo that holds a place corrects single counts every
/// few ten milliseconds.
inline constexpr double kRestTime = 0.1;

/// One event with both clocks.
struct Event {
  EventKind kind = EventKind::kFault;
  std::size_t index = 0;          ///< DAC or axis
  std::int64_t value = 0;         ///< as the kind says
  double plant_time = 0.0;        ///< simulated time [s]
  std::int64_t monotonic_ns = 0;  ///< CLOCK_MONOTONIC [ns]
};

/// Events in the order in which they happened: that of a rest is known only kRestTime later.
std::vector<Event> in_order(std::vector<Event> events);

/// "plant 1.234000 s, clock 5678.123456789 s: DAC 0 at 0x8000".
std::string to_string(const Event& event);

/// The last `capacity` events. For one thread.
class EventLog {
 public:
  /// Allocates all it ever needs.
  explicit EventLog(std::size_t capacity) : events_(capacity) {}

  /// Real-time safe; the oldest event gives way.
  void add(const Event& event) noexcept { events_[written_++ % events_.size()] = event; }
  /// Events ever added.
  std::size_t written() const noexcept { return written_; }
  /// Number of the oldest event that is still there.
  std::size_t first() const noexcept {
    return written_ > events_.size() ? written_ - events_.size() : 0;
  }
  /// Event number i, first() <= i < written().
  const Event& operator[](std::size_t i) const noexcept { return events_[i % events_.size()]; }

 private:
  std::vector<Event> events_;
  std::size_t written_ = 0;
};

/// Tells when a converter is driven and when it rests, without a word for every crossing of 0 V.
class RestWatch {
 public:
  /// Takes the code of this instant; true: `event` is worth telling. Its time is that at which the
  /// code came to 0x8000 or left it. Real-time safe.
  bool take(std::uint16_t code, double plant_time, Event& event) noexcept;

 private:
  bool is_driven_ = false;  // as told
  bool is_zero_ = true;
  double since_ = 0.0;         // at zero [s]
  std::int64_t since_ns_ = 0;  // the same on the clock [ns]
};

}  // namespace twin::hal::rig::emulator
