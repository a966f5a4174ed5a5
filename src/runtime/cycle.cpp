#include "runtime/cycle.hpp"

#include <chrono>

#include "servo/axis_scaling.hpp"

namespace twin::runtime {
namespace {

using WallClock = std::chrono::steady_clock;

double seconds_since(WallClock::time_point start) noexcept {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

servo::AxisServo make_servo(const hal::Machine* machine, std::size_t axis,
                            const std::array<servo::Gains, hal::kServoAxes>& gains, double period) {
  return {gains[axis], machine == nullptr ? 1.0 : machine->info().mm_per_s_per_volt[axis], period};
}

}  // namespace

Cycle::Cycle(interpolator::Interpolator& interpolator, hal::Machine* machine,
             const std::array<servo::Gains, hal::kServoAxes>& gains, double period)
    : interpolator_(interpolator),
      machine_(machine),
      period_(period),
      servos_{make_servo(machine, hal::kX, gains, period),
              make_servo(machine, hal::kY, gains, period)} {
  outputs_.servo_on = {true, true};
}

interpolator::Status Cycle::prepare() noexcept {
  const auto start = WallClock::now();
  const interpolator::Status status = interpolator_.step(set_point_);
  prepare_time_ = seconds_since(start);
  return status;
}

hal::Status Cycle::hold() noexcept {
  set_point_.velocity.setZero();
  set_point_.acceleration.setZero();
  trace::Sample unused;
  const std::int64_t periods = periods_;
  const hal::Status status = exchange(unused);
  periods_ = periods;
  return status;
}

hal::Status Cycle::exchange(trace::Sample& sample) noexcept {
  if (machine_ != nullptr) {
    if (machine_->read(inputs_) != hal::Status::kOk) {
      return hal::Status::kError;
    }
    const auto start = WallClock::now();
    const hal::MachineInfo& info = machine_->info();
    for (std::size_t i = 0; i < hal::kServoAxes; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      measured_[k] = servo::position_from_counts(inputs_.counts[i], info.mm_per_count[i]);
      outputs_.volts[i] = servos_[i].update(
          {set_point_.position[k], set_point_.velocity[k], set_point_.acceleration[k]},
          measured_[k]);
    }
    outputs_.position_reference = {set_point_.position.x(), set_point_.position.y(),
                                   set_point_.position.z()};
    servo_time_ = seconds_since(start);
    table_ = measured_;
    const auto take_truth = [&] {
      const hal::Truth truth = machine_->truth();
      table_ = {truth.table_position[0], truth.table_position[1]};
    };
    if (info.has_truth && !info.follows_reference) {
      take_truth();
    }
    if (machine_->write(outputs_) != hal::Status::kOk) {
      return hal::Status::kError;
    }
    if (info.follows_reference) {
      take_truth();
      measured_ = table_;
    }
  }
  sample.t = static_cast<double>(periods_++) * period_;
  sample.segment = set_point_.segment;
  sample.block = set_point_.block;
  sample.line = set_point_.line;
  sample.command = set_point_.position;
  sample.feedrate = set_point_.feedrate;
  sample.feedrate_limit = set_point_.feedrate_limit;
  sample.encoder = measured_;
  sample.table = table_;
  sample.volts = {outputs_.volts[0], outputs_.volts[1]};
  sample.cycle_time = prepare_time_ + servo_time_;
  return hal::Status::kOk;
}

}  // namespace twin::runtime
