#include "motion/safety/monitors.hpp"

namespace twin::motion {
namespace {

static_assert(Monitor<DriveAlarm> && Monitor<ReadyLost> && Monitor<Overtravel> &&
              Monitor<CountStep> && Monitor<FrozenEncoder> && Monitor<Runaway> &&
              Monitor<TrackingError> && Monitor<Saturation>);

AxisFacts facts_of(const hal::MachineInfo& info, std::size_t axis, double period,
                   double feedrate) noexcept {
  return {.period = period,
          .mm_per_count = info.mm_per_count[axis],
          .mm_per_s_per_volt = info.mm_per_s_per_volt[axis],
          .feedrate = feedrate};
}

/// Lets every monitor look, so that none misses a period; keeps the first finding.
template <Monitor... M>
std::optional<Finding> first_of(const AxisView& view, M&... monitors) noexcept {
  std::optional<Finding> found;
  const auto look = [&](auto& monitor) {
    const auto finding = monitor.check(view);
    if (!found) {
      found = finding;
    }
  };
  (look(monitors), ...);
  return found;
}

}  // namespace

AxisMonitors::AxisMonitors(const AxisFacts& axis, const SafetySettings& settings) noexcept
    : alarm_(axis, settings),
      ready_lost_(axis, settings),
      overtravel_(axis, settings),
      count_step_(axis, settings),
      frozen_encoder_(axis, settings),
      runaway_(axis, settings),
      tracking_error_(axis, settings),
      saturation_(axis, settings) {}

std::optional<Finding> AxisMonitors::check(const AxisView& view) noexcept {
  const auto always = first_of(view, alarm_, ready_lost_, overtravel_, count_step_);
  if (always || !view.servo_ready) {
    return always;
  }
  return first_of(view, frozen_encoder_, runaway_, tracking_error_, saturation_);
}

Monitors::Monitors(const hal::MachineInfo& info, double period, double feedrate,
                   const SafetySettings& settings) noexcept
    : axes_{AxisMonitors(facts_of(info, hal::kX, period, feedrate), settings),
            AxisMonitors(facts_of(info, hal::kY, period, feedrate), settings)} {}

std::optional<Trip> Monitors::check(const std::array<AxisView, hal::kServoAxes>& views) noexcept {
  std::optional<Trip> trip;
  for (std::size_t i = 0; i < hal::kServoAxes; ++i) {
    const auto finding = axes_[i].check(views[i]);
    if (!finding) {
      continue;
    }
    const Trip found{
        .kind = finding->kind, .axis = i, .value = finding->value, .limit = finding->limit};
    if (!trip || (!is_immediate(*trip) && is_immediate(found))) {
      trip = found;
    }
  }
  return trip;
}

}  // namespace twin::motion
