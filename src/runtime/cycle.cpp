#include "runtime/cycle.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "motion/servo/axis_servo.hpp"

namespace twin::runtime {
namespace {

/// A path may pass its program by the chord tolerance, on its outer side too, so the guard of the
/// travel lets that much pass; the check of the program lets nothing pass [mm].
constexpr double kTravelRounding = 0.05;

using WallClock = std::chrono::steady_clock;

double seconds_since(WallClock::time_point start) noexcept {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

motion::AxisServo make_servo(const hal::Machine* machine, std::size_t axis,
                             const std::array<motion::Gains, hal::kServoAxes>& gains,
                             double period) {
  return {gains[axis], machine == nullptr ? 1.0 : machine->info().mm_per_s_per_volt[axis], period};
}

}  // namespace

Cycle::Cycle(motion::Interpolator& interpolator, hal::Machine* machine,
             const std::array<motion::Gains, hal::kServoAxes>& gains, double period,
             const motion::SafetySettings& safety, const Limits& limits, Servo* servo)
    : interpolator_(interpolator),
      machine_(machine),
      servo_(servo),
      period_(period),
      limits_(limits),
      servos_{make_servo(machine, hal::kX, gains, period),
              make_servo(machine, hal::kY, gains, period)} {
  outputs_.servo_on = {true, true};
  if (machine != nullptr && !machine->info().follows_reference) {
    monitors_.emplace(machine->info(), period, limits.feedrate, safety);
  }
}

void Cycle::stand_at(const Vec3& place) noexcept {
  origin_ = place.head<2>();
  is_shifted_ = origin_ != Vec2::Zero();
  set_point_.position = place;
}

hal::Status Cycle::read(double interval) noexcept {
  interval_ = interval;
  return machine_ == nullptr ? hal::Status::kOk : machine_->read(inputs_);
}

motion::Status Cycle::prepare() noexcept {
  const auto start = WallClock::now();
  const motion::SetPoint last = set_point_;
  const motion::Status status = interpolator_.step(set_point_);
  if (status == motion::Status::kMoving) {
    keep_in_travel(last);
  }
  prepare_time_ = seconds_since(start);
  return status;
}

/// Goes back to the last set point where the present one lies outside the travel.
void Cycle::keep_in_travel(const motion::SetPoint& last) noexcept {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double place = set_point_.position[axis];
    const double low = limits_.travel_min[axis] - kTravelRounding;
    const double high = limits_.travel_max[axis] + kTravelRounding;
    if (place >= low && place <= high) {
      continue;
    }
    if (!trip_ || !is_immediate(*trip_)) {
      trip_ = stamped({.kind = motion::Kind::kOutsideTravel,
                       .axis = axis < 2 ? static_cast<std::size_t>(axis) : motion::kAxisZ,
                       .value = place,
                       .limit = place < low ? limits_.travel_min[axis] : limits_.travel_max[axis]});
    }
    set_point_ = last;
    set_point_.velocity.setZero();
    set_point_.acceleration.setZero();
    set_point_.feedrate = 0.0;
    return;
  }
}

Vec2 Cycle::position_of_counts() const noexcept {
  const auto& scale = machine_->info().mm_per_count;
  return shifted({motion::position_from_counts(inputs_.counts[hal::kX], scale[hal::kX]),
                  motion::position_from_counts(inputs_.counts[hal::kY], scale[hal::kY])});
}

Vec2 Cycle::true_position() const noexcept {
  const hal::Truth truth = machine_->truth();
  return shifted({truth.table_position[hal::kX], truth.table_position[hal::kY]});
}

/// Takes the drive commands of the caller's own loops; a trip where there are none.
void Cycle::ask_servo() noexcept {
  const auto array_of = [](const Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
  const SetPoint point{.time = time(),
                       .position = array_of(set_point_.position),
                       .velocity = array_of(set_point_.velocity),
                       .acceleration = array_of(set_point_.acceleration),
                       .feedrate = set_point_.feedrate,
                       .segment = set_point_.segment,
                       .line = set_point_.line};
  const auto volts = servo_->volts(point, {measured_.x(), measured_.y()});
  for (std::size_t i = 0; i < hal::kServoAxes; ++i) {
    if (!volts || !std::isfinite((*volts)[i])) {
      trip_ = stamped({.kind = motion::Kind::kServoFailed, .axis = volts ? i : motion::kNoAxis});
      return;
    }
    outputs_.volts[i] = std::clamp((*volts)[i], -motion::kMaxVolts, motion::kMaxVolts);
    is_saturated_[i] = outputs_.volts[i] != (*volts)[i];
  }
}

/// Counts to drive commands.
void Cycle::close_loops() noexcept {
  measured_ = position_of_counts();
  table_ = measured_;
  outputs_.position_reference = {set_point_.position.x(), set_point_.position.y(),
                                 set_point_.position.z()};
  if (is_shifted_) {
    outputs_.position_reference[hal::kX] -= origin_.x();
    outputs_.position_reference[hal::kY] -= origin_.y();
  }
  if (servo_ != nullptr) {
    ask_servo();
    return;
  }
  for (std::size_t i = 0; i < hal::kServoAxes; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    outputs_.volts[i] = servos_[i].update({.position = set_point_.position[k],
                                           .velocity = set_point_.velocity[k],
                                           .acceleration = set_point_.acceleration[k]},
                                          measured_[k]);
    is_saturated_[i] = servos_[i].is_saturated();
  }
}

/// Lets the monitors look; false when the outputs must be made safe.
bool Cycle::is_safe() noexcept {
  if (!monitors_) {
    return true;
  }
  std::array<motion::AxisView, hal::kServoAxes> views;
  const double feedrate = set_point_.velocity.norm();
  for (std::size_t i = 0; i < hal::kServoAxes; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    views[i] = {.interval = interval_,
                .command = set_point_.position[k],
                .velocity = set_point_.velocity[k],
                .feedrate = feedrate,
                .measured = measured_[k],
                .counts = inputs_.counts[i],
                .volts = outputs_.volts[i],
                .is_saturated = is_saturated_[i],
                .servo_ready = inputs_.servo_ready[i],
                .alarm = inputs_.alarm[i],
                .limit_positive = inputs_.limit_positive[i],
                .limit_negative = inputs_.limit_negative[i]};
  }
  const auto found = monitors_->check(views);
  if (!found) {
    return true;
  }
  if (!trip_ || is_immediate(*found)) {
    trip_ = stamped(*found);
  }
  return !is_immediate(*found);
}

bool Cycle::write() noexcept {
  const hal::MachineInfo& info = machine_->info();
  if (info.has_truth && !info.follows_reference) {
    const hal::Truth truth = machine_->truth();
    table_ = shifted({truth.table_position[hal::kX], truth.table_position[hal::kY]});
    torque_ = {truth.motor_torque[hal::kX], truth.motor_torque[hal::kY]};
    friction_ = {truth.friction_force[hal::kX], truth.friction_force[hal::kY]};
  }
  if (machine_->write(outputs_) != hal::Status::kOk) {
    return false;
  }
  if (info.follows_reference) {
    measured_ = table_ = true_position();
  }
  return true;
}

hal::Status Cycle::respond(results::Sample& sample) noexcept {
  bool is_fine = !is_switched_off();
  if (machine_ != nullptr) {
    const auto start = WallClock::now();
    close_loops();
    is_fine = is_safe() && !is_switched_off();
    if (!is_fine) {
      outputs_.volts.fill(0.0);
      outputs_.servo_on.fill(false);
    }
    servo_time_ = seconds_since(start);
    is_fine = write() && is_fine;
  }
  fill(sample);
  ++periods_;
  return is_fine ? hal::Status::kOk : hal::Status::kError;
}

hal::Status Cycle::respond_at_rest() noexcept {
  set_point_.velocity.setZero();
  set_point_.acceleration.setZero();
  results::Sample unused;
  const std::int64_t periods = periods_;
  prepare_time_ = 0.0;
  const hal::Status status = respond(unused);
  periods_ = periods;
  return status;
}

void Cycle::pass_over(results::Sample& sample, double share) noexcept {
  fill(sample);
  const Vec2 now = position_of_counts();
  sample.encoder = measured_ + share * (now - measured_);
  sample.table = machine_->info().has_truth ? Vec2(table_ + share * (true_position() - table_))
                                            : sample.encoder;
  sample.is_passed_over = true;
  ++periods_;
}

hal::Status Cycle::exchange(results::Sample& sample) noexcept {
  return read(period_) == hal::Status::kOk ? respond(sample) : hal::Status::kError;
}

hal::Status Cycle::hold() noexcept {
  return read(period_) == hal::Status::kOk ? respond_at_rest() : hal::Status::kError;
}

void Cycle::fill(results::Sample& sample) const noexcept {
  sample.t = time();
  sample.segment = set_point_.segment;
  sample.block = set_point_.block;
  sample.line = set_point_.line;
  sample.command = set_point_.position;
  sample.feedrate = set_point_.feedrate;
  sample.feedrate_limit = set_point_.feedrate_limit;
  sample.encoder = measured_;
  sample.table = table_;
  sample.volts = {outputs_.volts[0], outputs_.volts[1]};
  sample.torque = torque_;
  sample.friction = friction_;
  sample.cycle_time = prepare_time_ + servo_time_;
}

std::size_t Cycle::axis_not_ready() const noexcept {
  const auto& ready = inputs_.servo_ready;
  return static_cast<std::size_t>(std::find(ready.begin(), ready.end(), false) - ready.begin());
}

motion::Trip Cycle::stamped(motion::Trip trip) const noexcept {
  trip.time = time();
  trip.line = set_point_.line;
  return trip;
}

void Cycle::switch_off() noexcept {
  if (machine_ != nullptr) {
    machine_->deactivate();
  }
}

}  // namespace twin::runtime
