#include "motion/safety/monitors.hpp"

#include <algorithm>
#include <cmath>

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

std::optional<Finding> DriveAlarm::check(const AxisView& view) noexcept {
  return view.alarm ? std::optional(Finding{.kind = Kind::kDriveAlarm, .value = 1.0, .limit = 0.0})
                    : std::nullopt;
}

std::optional<Finding> ReadyLost::check(const AxisView& view) noexcept {
  const bool is_lost = was_ready_ && !view.servo_ready;
  was_ready_ = was_ready_ || view.servo_ready;
  return is_lost ? std::optional(Finding{.kind = Kind::kReadyLost, .value = 0.0, .limit = 1.0})
                 : std::nullopt;
}

std::optional<Finding> Overtravel::check(const AxisView& view) noexcept {
  if (is_first_) {
    is_first_ = false;
    starts_on_positive_ = view.limit_positive;
    starts_on_negative_ = view.limit_negative;
  }
  closed_ = view.limit_positive || view.limit_negative ? 0.0 : closed_ + view.interval;
  starts_on_positive_ = starts_on_positive_ && closed_ < kBounce;
  starts_on_negative_ = starts_on_negative_ && closed_ < kBounce;
  if (view.limit_positive && (!starts_on_positive_ || view.velocity > 0.0)) {
    return Finding{.kind = Kind::kPositiveLimit, .value = view.measured, .limit = 0.0};
  }
  if (view.limit_negative && (!starts_on_negative_ || view.velocity < 0.0)) {
    return Finding{.kind = Kind::kNegativeLimit, .value = view.measured, .limit = 0.0};
  }
  return std::nullopt;
}

CountStep::CountStep(const AxisFacts& axis, const SafetySettings& settings) noexcept
    : period_(axis.period),
      speed_(settings.count_step_ratio * axis.feedrate),
      rounding_(2.0 * std::abs(axis.mm_per_count)) {}

std::optional<Finding> CountStep::check(const AxisView& view) noexcept {
  const double step = has_last_ ? std::abs(view.measured - last_) : 0.0;
  const double limit = speed_ * std::max(period_, view.interval) + rounding_;
  has_last_ = true;
  last_ = view.measured;
  if (step > limit) {
    return Finding{.kind = Kind::kCountStep, .value = step, .limit = limit};
  }
  return std::nullopt;
}

FrozenEncoder::FrozenEncoder(const AxisFacts& axis, const SafetySettings& settings) noexcept
    : period_(axis.period), limit_(settings.frozen_encoder + 2.0 * std::abs(axis.mm_per_count)) {}

std::optional<Finding> FrozenEncoder::check(const AxisView& view) noexcept {
  if (!has_last_ || view.counts != counts_ || is_late(view, period_)) {
    has_last_ = true;
    counts_ = view.counts;
    lowest_ = highest_ = view.command;
    return std::nullopt;
  }
  lowest_ = std::min(lowest_, view.command);
  highest_ = std::max(highest_, view.command);
  const double way = highest_ - lowest_;
  if (way > limit_) {
    return Finding{.kind = Kind::kEncoderFrozen, .value = way, .limit = limit_};
  }
  return std::nullopt;
}

Runaway::Runaway(const AxisFacts& axis, const SafetySettings& settings) noexcept
    : period_(axis.period),
      mm_per_s_per_volt_(axis.mm_per_s_per_volt),
      per_feedrate_(settings.runaway_per_feedrate),
      limit_(std::max(settings.runaway, kLeastCounts * std::abs(axis.mm_per_count))) {}

std::optional<Finding> Runaway::check(const AxisView& view) noexcept {
  const double step = has_last_ ? view.measured - last_measured_ : 0.0;
  const double u = last_velocity_;
  if (std::abs(u) > kLeastVelocity) {
    wrong_way_ = std::max(0.0, wrong_way_ - std::copysign(1.0, u) * step);
  }
  after_late_ = is_late(view, period_) ? kAfterLate : std::max(0.0, after_late_ - view.interval);
  if (after_late_ > 0.0) {
    wrong_way_ = 0.0;
  }
  has_last_ = true;
  last_measured_ = view.measured;
  last_velocity_ = view.volts * mm_per_s_per_volt_;
  const double error = view.command - view.measured;
  const double limit = limit_ + (per_feedrate_ + period_) * view.feedrate;
  if (wrong_way_ > 0.5 * limit && std::abs(error) > limit && error * last_velocity_ > 0.0) {
    return Finding{.kind = Kind::kRunaway, .value = std::abs(error), .limit = limit};
  }
  return std::nullopt;
}

TrackingError::TrackingError(const AxisFacts& /*axis*/, const SafetySettings& settings) noexcept
    : least_(settings.tracking_error),
      per_feedrate_(settings.tracking_error_per_feedrate),
      filter_time_(settings.tracking_filter_time) {}

std::optional<Finding> TrackingError::check(const AxisView& view) noexcept {
  const double error = std::abs(view.command - view.measured);
  const double limit = least_ + per_feedrate_ * std::abs(view.feedrate);
  if (error <= limit) {
    exceeded_for_ = 0.0;
    return std::nullopt;
  }
  exceeded_for_ += view.interval;
  if (exceeded_for_ > filter_time_ || !(error <= 2.0 * limit)) {
    return Finding{.kind = Kind::kTrackingError, .value = error, .limit = limit};
  }
  return std::nullopt;
}

Saturation::Saturation(const AxisFacts& /*axis*/, const SafetySettings& settings) noexcept
    : limit_(settings.saturation_time) {}

std::optional<Finding> Saturation::check(const AxisView& view) noexcept {
  time_ = view.is_saturated ? time_ + view.interval : 0.0;
  if (time_ > limit_) {
    return Finding{.kind = Kind::kSaturation, .value = time_, .limit = limit_};
  }
  return std::nullopt;
}

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
