#include "studies/commissioning/wiring_check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hal/active_machine.hpp"

namespace twin::studies::commissioning {
namespace {

constexpr double kNoMotionShare = 0.1;
constexpr double kScaleTolerance = 0.2;

constexpr char axis_name(std::size_t axis) { return axis == hal::kX ? 'x' : 'y'; }

/// One open-loop exchange with the machine after another.
class Prober {
 public:
  Prober(hal::Machine& machine, const WiringCheckSettings& settings, double period,
         const WaitForPeriod& wait, const std::atomic<bool>& stop)
      : machine_(machine), settings_(settings), period_(period), wait_(wait), stop_(stop) {}

  Expected<AxisWiringReport> check(std::size_t axis);
  /// One period at rest with the servos off.
  Expected<void> look() { return exchange(); }

 private:
  using Velocities = std::array<double, hal::kServoAxes>;  // [mm/s]

  Expected<void> exchange();
  Expected<void> examine(std::size_t axis) const;
  Expected<void> wait_until_ready(std::size_t axis);
  Expected<Velocities> hold(std::size_t axis, double volts, double time);
  double position(std::size_t axis) const {
    return static_cast<double>(inputs_.counts[axis]) * machine_.info().mm_per_count[axis];
  }

  hal::Machine& machine_;
  const WiringCheckSettings& settings_;
  double period_;
  const WaitForPeriod& wait_;
  const std::atomic<bool>& stop_;
  hal::Inputs inputs_;
  hal::Outputs outputs_;
  Velocities start_{};  // positions when the axis was begun [mm]
};

Expected<void> Prober::examine(std::size_t axis) const {
  const auto refuse = [&](const std::string& what) {
    return fail(ErrorCode::kMachine, fmt::format("axis {}: {}", axis_name(axis), what));
  };
  if (inputs_.alarm[axis]) {
    return refuse("the drive has an alarm, or its ALM line is open");
  }
  if (inputs_.limit_positive[axis] || inputs_.limit_negative[axis]) {
    return refuse(fmt::format("limit switch {} is reached or its line is open",
                              inputs_.limit_positive[axis] ? "P-OT" : "N-OT"));
  }
  const double travel = position(axis) - start_[axis];
  if (std::abs(travel) > settings_.largest_travel) {
    return refuse(fmt::format("moved {:.3f} mm, more than the {:g} mm of this check; servo off",
                              travel, settings_.largest_travel));
  }
  return {};
}

Expected<void> Prober::exchange() {
  const auto failed = [&] { return fail(ErrorCode::kMachine, machine_.last_error()); };
  if (machine_.read(inputs_) != hal::Status::kOk) {
    return failed();
  }
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    if (auto sound = examine(axis); !sound) {
      return sound;
    }
  }
  if (stop_.load()) {
    return fail(ErrorCode::kInterrupted, "interrupted: 0 V, servo off");
  }
  if (machine_.write(outputs_) != hal::Status::kOk) {
    return failed();
  }
  wait_();
  return {};
}

Expected<void> Prober::wait_until_ready(std::size_t axis) {
  const auto periods = std::lround(settings_.ready_timeout / period_);
  for (long i = 0; i < periods; ++i) {
    if (auto done = exchange(); !done) {
      return done;
    }
    if (inputs_.servo_ready[axis]) {
      return {};
    }
  }
  return fail(ErrorCode::kMachine,
              fmt::format("axis {}: no /S-RDY within {:g} s of /S-ON; check both lines, main power "
                          "and the drive's display",
                          axis_name(axis), settings_.ready_timeout));
}

/// Mean velocities over the second half of a time at a voltage.
Expected<Prober::Velocities> Prober::hold(std::size_t axis, double volts, double time) {
  outputs_.volts = {};
  outputs_.volts[axis] = volts;
  const auto half = std::max(1L, std::lround(0.5 * time / period_));
  Velocities from{};
  for (long i = 0; i < 2 * half; ++i) {
    if (i == half) {
      from = {position(hal::kX), position(hal::kY)};
    }
    TWIN_CHECK(exchange());
  }
  const double elapsed = static_cast<double>(half) * period_;
  return Velocities{(position(hal::kX) - from[0]) / elapsed,
                    (position(hal::kY) - from[1]) / elapsed};
}

Finding judge(const AxisWiringReport& report) {
  const double share = report.measured_scale / report.expected_scale;
  if (std::abs(share) < kNoMotionShare) {
    return std::abs(report.other_scale / report.expected_scale) > kNoMotionShare
               ? Finding::kOtherAxis
               : Finding::kNoMotion;
  }
  if (share < 0.0) {
    return Finding::kReversed;
  }
  return std::abs(share - 1.0) > kScaleTolerance ? Finding::kScale : Finding::kSound;
}

Expected<AxisWiringReport> Prober::check(std::size_t axis) {
  const std::size_t other = 1 - axis;
  start_ = {position(hal::kX), position(hal::kY)};
  outputs_ = {};
  outputs_.servo_on[axis] = true;
  TWIN_CHECK(wait_until_ready(axis));
  AxisWiringReport report;
  report.expected_scale = machine_.info().mm_per_s_per_volt[axis];
  const double volts = settings_.velocity / report.expected_scale;
  const std::array<double, 5> steps{0.0, volts, 0.0, -volts, 0.0};
  std::array<Velocities, 5> velocities{};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    TWIN_TRY(auto held, hold(axis, steps[i], steps[i] == 0.0 ? settings_.rest : settings_.pulse));
    velocities[i] = held;
  }
  outputs_ = {};
  report.drift = velocities[0][axis];
  report.measured_scale = (velocities[1][axis] - velocities[3][axis]) / (2.0 * volts);
  report.other_scale = (velocities[1][other] - velocities[3][other]) / (2.0 * volts);
  report.finding = judge(report);
  TWIN_CHECK(exchange());
  return report;
}

}  // namespace

Expected<WiringReport> check_wiring(hal::Machine& machine, const WiringCheckSettings& settings,
                                    double period, const WaitForPeriod& wait,
                                    const std::atomic<bool>& stop) {
  hal::ActiveMachine active(&machine);
  TWIN_CHECK(active.start(period));
  Prober prober(machine, settings, period, wait, stop);
  TWIN_CHECK(prober.look());
  WiringReport report;
  for (std::size_t axis = 0; axis < hal::kServoAxes; ++axis) {
    TWIN_TRY(auto checked, prober.check(axis));
    report[axis] = checked;
  }
  return report;
}

std::string advice(const AxisWiringReport& report, const std::string& axis) {
  const double ratio = report.measured_scale / report.expected_scale;
  switch (report.finding) {
    case Finding::kSound:
      return "sound";
    case Finding::kReversed:
      return fmt::format(
          "REVERSED: the encoder counts against the command. If the table moved the right way, "
          "turn "
          "rig.{0}.encoder_reversed round, else rig.{0}.vref_reversed. Do not close the loop "
          "before",
          axis);
    case Finding::kScale:
      return fmt::format(
          "scale is {:.3g} times what the settings say: check rig.{}.encoder_um_per_count, the "
          "V-REF "
          "scale and the drive's Pn300 and encoder divider",
          ratio, axis);
    case Finding::kNoMotion:
      return fmt::format(
          "does not move: check rig.{0}.dac, rig.{0}.counter, the V-REF and encoder cables and "
          "rig.{0}.servo_on",
          axis);
    case Finding::kOtherAxis:
      return fmt::format(
          "the other axis' encoder moves: rig.x and rig.y have dac or counter swapped");
  }
  return {};
}

}  // namespace twin::studies::commissioning
