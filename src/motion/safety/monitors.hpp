#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hal/machine.hpp"
#include "motion/motion_settings.hpp"
#include "motion/safety/axis_view.hpp"

namespace twin::motion {

/// Drive alarm; a broken wire counts as one where the machine reads its lines that way.
class DriveAlarm {
 public:
  DriveAlarm(const AxisFacts& /*axis*/, const SafetySettings& /*settings*/) noexcept {}

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;
};

/// Servo ready that went off after it had come.
class ReadyLost {
 public:
  ReadyLost(const AxisFacts& /*axis*/, const SafetySettings& /*settings*/) noexcept {}

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  bool was_ready_ = false;
};

/// Limit switches P-OT and N-OT.
///
/// A switch that is met trips. Where the axis stands on a switch before the first period, as after
/// a stop on it, the switch trips only when the set point moves towards it, so that the axis can be
/// driven off. The axis counts as on it until the switch has been closed for kBounce, because
/// switches bounce and an axis at the edge trembles.
class Overtravel {
 public:
  Overtravel(const AxisFacts& /*axis*/, const SafetySettings& /*settings*/) noexcept {}

  static constexpr double kBounce = 0.1;  ///< [s]

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  bool is_first_ = true;
  double closed_ = 0.0;  // how long both switches have been closed [s]
  bool starts_on_positive_ = false;
  bool starts_on_negative_ = false;
};

/// A change of the counts that no motion explains: a counter that was reset, a bad read.
///
/// The largest plausible step of a period is that of a multiple of the largest feedrate, plus what
/// counting rounds off.
class CountStep {
 public:
  CountStep(const AxisFacts& axis, const SafetySettings& settings) noexcept;

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  double period_;    // [s]
  double speed_;     // [mm/s]
  double rounding_;  // [mm]
  double last_ = 0.0;
  bool has_last_ = false;
};

/// Counts that stand while the command moves: a broken encoder wire, a stuck counter.
///
/// The monitor looks at the range that the command has covered since the counts last changed, so
/// that a command that swings within less than a count does not trip it. After a late period it
/// begins anew: the command has gone on by the clock, and the counts may be older than that.
class FrozenEncoder {
 public:
  FrozenEncoder(const AxisFacts& axis, const SafetySettings& settings) noexcept;

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  double period_;         // [s]
  double limit_;          // [mm]
  double lowest_ = 0.0;   // command since the counts changed [mm]
  double highest_ = 0.0;  // [mm]
  std::int64_t counts_ = 0;
  bool has_last_ = false;
};

/// An axis that moves against its drive command: encoder or V-REF turned round.
///
/// With a wrong sign the loop feeds back positively, and the error grows within milliseconds. Two
/// things show a wrong sign before the error is large; u is the last drive command [mm/s]:
///   the measured position y moves against u; the way w that it has done so is
///     w += -dy sign(u), never below 0                                               [mm]
///   and the tracking error e is one that u should make smaller, e u > 0.
/// The monitor trips when w exceeds half the limit and |e| exceeds the limit. The limit grows with
/// the feedrate and with what u moves in a period.
///
/// A sound axis moves against u for some milliseconds after a reversal, because it lags, but its
/// error is small then. A sound axis also runs on while a period is late, and is called back after
/// it. So nothing counts for kAfterLate after a late period; the limit of the tracking error stands
/// meanwhile.
class Runaway {
 public:
  Runaway(const AxisFacts& axis, const SafetySettings& settings) noexcept;

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  static constexpr double kLeastCounts = 4.0;    // least limit at rest [counts]
  static constexpr double kLeastVelocity = 1.0;  // below it u is offset and hum [mm/s]
  static constexpr double kAfterLate = 0.02;     // [s]

  double period_;  // [s]
  double mm_per_s_per_volt_;
  double per_feedrate_;         // [s]
  double limit_;                // at rest [mm]
  double after_late_ = 0.0;     // left of kAfterLate [s]
  double wrong_way_ = 0.0;      // w [mm]
  double last_measured_ = 0.0;  // [mm]
  double last_velocity_ = 0.0;  // u [mm/s]
  bool has_last_ = false;
};

/// Tracking error against a limit that grows with the feedrate F:
///
///   |e| <= e_0 + c F
///
/// as LinuxCNC's MIN_FERROR and FERROR have it. The limit may be exceeded for the filter time, as
/// in Beckhoff's position lag monitoring, so that one bad instant is no fault; twice the limit is
/// one at once.
class TrackingError {
 public:
  TrackingError(const AxisFacts& axis, const SafetySettings& settings) noexcept;

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  double least_;               // e_0 [mm]
  double per_feedrate_;        // c [s]
  double filter_time_;         // [s]
  double exceeded_for_ = 0.0;  // [s]
};

/// A drive command that is cut to +-10 V for too long: the axis cannot follow.
class Saturation {
 public:
  Saturation(const AxisFacts& axis, const SafetySettings& settings) noexcept;

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  double limit_;       // [s]
  double time_ = 0.0;  // [s]
};

/// All monitors of one axis, in order of how much they say: of two that trip in the same period the
/// first is reported.
///
///   always                alarm, servo ready lost, limit switches, count step
///   while servo is ready  frozen encoder, runaway, tracking error, saturation
class AxisMonitors {
 public:
  AxisMonitors(const AxisFacts& axis, const SafetySettings& settings) noexcept;

  /// Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  DriveAlarm alarm_;
  ReadyLost ready_lost_;
  Overtravel overtravel_;
  CountStep count_step_;
  FrozenEncoder frozen_encoder_;
  Runaway runaway_;
  TrackingError tracking_error_;
  Saturation saturation_;
};

/// The monitors of a machine: look at every period between servo and write.
class Monitors {
 public:
  /// @param info      scales of the machine
  /// @param period    interpolation period T [s]
  /// @param feedrate  largest feedrate of the machine [mm/s]
  Monitors(const hal::MachineInfo& info, double period, double feedrate,
           const SafetySettings& settings) noexcept;

  /// The first thing found, of X before Y; an immediate reaction before a controlled one. Time and
  /// line are left to the caller. Real-time safe.
  std::optional<Trip> check(const std::array<AxisView, hal::kServoAxes>& views) noexcept;

 private:
  std::array<AxisMonitors, hal::kServoAxes> axes_;
};

}  // namespace twin::motion
