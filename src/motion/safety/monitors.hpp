#pragma once

#include <array>
#include <optional>

#include "hal/machine.hpp"
#include "motion/safety/axis_view.hpp"
#include "motion/safety/count_step.hpp"
#include "motion/safety/drive_state.hpp"
#include "motion/safety/frozen_encoder.hpp"
#include "motion/safety/overtravel.hpp"
#include "motion/safety/runaway.hpp"
#include "motion/safety/safety_settings.hpp"
#include "motion/safety/saturation.hpp"
#include "motion/safety/tracking_error.hpp"

namespace twin::motion {

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
