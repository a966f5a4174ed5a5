#include "shadow/axis_observer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/atomic_file.hpp"
#include "core/units.hpp"

namespace twin::shadow {
namespace {

/// Way in kMemory periods of a motion [counts]: slower, and rounding is a saw tooth and no noise.
constexpr double kLeastWay = 12.0;
/// Periods of a motion that are left out: what friction and the drive's integral were at rest shows
/// in them, and nobody knows it.
constexpr std::size_t kBegin = 3 * AxisObserver::kMemory;
/// The same where the force is compared, whose filter is over sooner.
constexpr std::size_t kForceBegin = 32;
/// Periods for which the models have had the hum before a scale says anything: the counts
/// of the encoder, from which it is found, know it to a part of a count, and a scale sees the rest.
constexpr std::size_t kHumOfScale = 1000;
// What a slide stands slower than, and for how long, until it counts as having stood: a smooth turn
// is over sooner.
constexpr double kStanding = 0.5;          // [mm/s]
constexpr double kSlow = 2.0;              // below, friction may hold the slide [mm/s]
constexpr std::size_t kStoodFor = 20;      // [periods]
constexpr double kFastWay = 4.0;           // within kAround of a period, of a direction [counts]
constexpr double kLeastWayOfAny = 0.5e-3;  // the same where counts are fine [mm]

void set(PerParameter& all, Cause cause, double value) {
  all[static_cast<std::size_t>(cause)] = value;
}

}  // namespace

AxisObserver::AxisObserver(const config::MachineFile& machine, hal::Axis axis, bool gives,
                           Recorded recorded)
    : mm_per_count_(std::abs(machine.table.axis[axis].encoder.mm_per_count)) {
  const hal::mujoco::AxisParams& params = machine.table.axis[axis];
  const bool is_torque_mode = params.drive.mode == hal::mujoco::DriveMode::kTorque;
  if (recorded.has_volts && !is_torque_mode) {
    channels_ = {ChannelKind::kPosition};
    if (machine.shadow.reads_counts) {
      channels_.push_back(ChannelKind::kCounts);
    }
    hum_angle_ = params.drive.hum_amplitude > 0.0
                     ? 2.0 * std::numbers::pi * params.drive.hum_frequency_Hz * machine.period
                     : 0.0;
    bank_.emplace(params, machine.period, machine.table.physics_step, gives);
    if (recorded.has_scale) {
      channels_.push_back(ChannelKind::kScale);
    }
  }
  if (recorded.has_force || (recorded.has_volts && is_torque_mode)) {
    channels_.push_back(ChannelKind::kForce);
    balance_.emplace(params, machine.period);
    if (!recorded.has_force) {
      force_per_volt_ = params.torque_per_volt() / units::m_from_mm(params.mm_per_rad());
    }
  }
}

ChannelFacts AxisObserver::facts(std::size_t channel) const {
  const ChannelKind kind = channels_[channel];
  if (kind != ChannelKind::kPosition && kind != ChannelKind::kCounts) {
    return {};
  }
  constexpr std::size_t kPeriods = std::max(kLongestFilter + 1, OnsetBank::kLasts);
  return {units::um_from_mm(mm_per_count_), hum_angle_, bank_->force_response(kPeriods)};
}

void AxisObserver::judge_motion(double measured, Observation& seen) noexcept {
  const auto ago = [&](std::size_t periods) {
    return places_[(next_ + kPlaces - periods) % kPlaces];
  };
  seen.counts = seen_ == 0 ? 0.0 : std::abs(measured - ago(1)) / mm_per_count_;
  if (seen_ < kPlaces) {
    ++seen_;
  } else {
    const double least = std::max(kLeastWay * mm_per_count_, kLeastWayOfAny);
    since_motion_ = std::abs(measured - ago(kMemory)) >= least ? 0 : since_motion_ + 1;
    stood_for_ = bank_ && std::abs(bank_->velocity()) < kStanding ? stood_for_ + 1 : 0;
    in_motion_ = since_motion_ < kMemory && stood_for_ < kStoodFor ? in_motion_ + 1 : 0;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const std::size_t hum = channels_[i] == ChannelKind::kScale ? kHumOfScale : kBegin;
      seen.moves[i] = channels_[i] == ChannelKind::kForce
                          ? in_motion_ > kForceBegin
                          : in_motion_ > kBegin && has_hum_for_ > hum;
    }
    const double speed = bank_ ? bank_->velocity() : 0.0;
    seen.is_slow = std::abs(speed) < kSlow;
    seen.heading = std::abs(speed) < kStanding ? 0.0 : speed > 0.0 ? 1.0 : -1.0;
    const double way = ago(kMemory - kAround) - ago(kMemory + kAround);
    const bool is_fast = std::abs(way) >= kFastWay * mm_per_count_;
    seen.direction = !is_fast ? 0.0 : way > 0.0 ? 1.0 : -1.0;
  }
  places_[next_] = measured;
  next_ = (next_ + 1) % kPlaces;
}

Observation AxisObserver::step(const AxisSample& sample) noexcept {
  Observation seen;
  const double force = force_per_volt_ != 0.0 ? force_per_volt_ * sample.volts : sample.force;
  if (seen_ == 0) {
    places_.fill(sample.measured);
    if (bank_) {
      bank_->begin(sample.measured, sample.volts);
    }
    if (balance_) {
      balance_->begin(sample.measured, force);
    }
  }
  std::size_t channel = 0;
  if (bank_) {
    seen.row[0] = bank_->step(sample.measured, sample.volts, in_motion_ > kMemory);
    channel = 1;
    if (channel < channels_.size() && channels_[channel] == ChannelKind::kCounts) {
      seen.row[channel++] = seen.row[0];
    }
  }
  has_hum_for_ += !bank_ || bank_->has_hum() ? 1 : 0;
  if (channel < channels_.size() && channels_[channel] == ChannelKind::kScale) {
    seen.row[channel++] = bank_->slide_row(sample.scale);
  }
  if (balance_) {
    seen.row[channel] = balance_->step(sample.measured, force);
  }
  judge_motion(sample.measured, seen);
  return seen;
}

PerParameter loosely_known(const hal::mujoco::AxisParams& params) {
  PerParameter known{};
  const double mass = params.moving_mass + params.rotor_mass();
  set(known, Cause::kFriction, 0.5);
  set(known, Cause::kVrefGain, 0.05);
  set(known, Cause::kLoopGain, 0.3);
  set(known, Cause::kOffset, 0.02);
  set(known, Cause::kInertia, 0.3 * mass);
  set(known, Cause::kForce, std::max(0.5 * params.friction.coulomb, 1.0));
  set(known, Cause::kStiffness, 0.3);
  set(known, Cause::kBacklash, 2e-3);
  set(known, Cause::kMotorForce, 0.2);
  return known;
}

PerParameter plausible(const hal::mujoco::AxisParams& params) {
  PerParameter limit{};
  const double mass = params.moving_mass + params.rotor_mass();
  set(limit, Cause::kFriction, 5.0);
  set(limit, Cause::kVrefGain, 2.0);
  set(limit, Cause::kLoopGain, 5.0);
  set(limit, Cause::kOffset, 1.0);
  set(limit, Cause::kInertia, 3.0 * mass);
  set(limit, Cause::kForce, 100.0 * std::max(params.friction.coulomb, 1.0));
  set(limit, Cause::kStiffness, 20.0);
  set(limit, Cause::kBacklash, 0.5);
  set(limit, Cause::kMotorForce, 3.0);
  return limit;
}

PerParameter known_by_file(const config::MachineFile& machine, hal::Axis axis) {
  const hal::mujoco::AxisParams& params = machine.table.axis[axis];
  const config::UncertaintySettings& u = machine.uncertainty;
  PerParameter known{};
  set(known, Cause::kFriction, u.friction);
  set(known, Cause::kLoopGain, u.loop_gain);
  set(known, Cause::kOffset, u.offset * std::abs(params.drive.vref_offset));
  set(known, Cause::kInertia, u.inertia * (params.moving_mass + params.rotor_mass()));
  set(known, Cause::kForce, u.friction * params.friction.coulomb);
  return known;
}

Expected<bool> screws_give(const config::MachineFile& machine) {
  TWIN_TRY(const std::string text, read_whole_file(machine.table.model));
  return text.find("\"x_screw\"") != std::string::npos;
}

}  // namespace twin::shadow
