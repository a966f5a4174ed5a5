#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hal/machine.hpp"
#include "motion/interpolator/interpolator.hpp"
#include "motion/motion_settings.hpp"
#include "motion/safety/monitors.hpp"
#include "motion/servo/axis_servo.hpp"
#include "results/trace/sample.hpp"
#include "twin/servo.hpp"

namespace twin::runtime {

/// The work of one interpolation period: computes the set point, closes the position loops and
/// exchanges signals with the machine.
///
///   read()       machine.read: counts and switches of this instant
///   prepare()    interpolator -> set point of the period
///   respond()    servo -> monitors -> machine.write
///
/// On the wall clock the calls come in this order, so the counts are read right at the begin of the
/// period. In lockstep prepare() comes first, and exchange() does the other two: if there is no set
/// point yet, the machine is not read and no simulated time passes. Both orders give the same
/// results, because the set point does not depend on what is measured. No call allocates, locks,
/// throws, prints or touches a file, apart from what the interpolator's source does in prepare().
///
/// The monitors (motion::Monitors) watch every machine that does not follow its reference exactly.
/// Before that, whatever the planner says, no set point outside the travel is ever used: the last
/// one stays, which is a trip. trip() returns what was found first. If a trip calls for an immediate reaction, the cycle
/// writes 0 V and servo off in the same period, returns kError, and writes nothing from then on.
class Cycle {
 public:
  /// @param machine   an active machine; null to compute set points without a machine
  /// @param period    interpolation period T [s]
  /// @param limits    largest feedrate and travel of the machine
  /// @param servo     position loops in place of those with these gains; may be null
  Cycle(motion::Interpolator& interpolator, hal::Machine* machine,
        const std::array<motion::Gains, hal::kServoAxes>& gains, double period,
        const motion::SafetySettings& safety = {}, const Limits& limits = {},
        Servo* servo = nullptr);

  /// Says where the machine stands before the first period: its counters begin at 0 there [mm].
  void stand_at(const Vec3& place) noexcept;

  /// Reads the inputs of the machine. Real-time safe.
  /// @param interval  time since the last read [s]
  hal::Status read(double interval) noexcept;
  /// Computes the next set point. If the result is not kMoving, the last set point stays in force.
  /// Real-time safe.
  motion::Status prepare() noexcept;
  /// Computes drive commands from the set point and the inputs, checks them and writes them to the
  /// machine. Real-time safe.
  /// @param sample  gets set point, measured values and drive commands of this period
  hal::Status respond(results::Sample& sample) noexcept;
  /// Like respond(), but holds the last set point, with velocity and acceleration 0, and records
  /// nothing. Real-time safe.
  hal::Status respond_at_rest() noexcept;
  /// Records a set point whose period was missed, and writes nothing to the machine. The measured
  /// values of the sample are interpolated between the last period and the inputs just read.
  /// Real-time safe.
  /// @param share  0 for the values of the last period, 1 for those just read
  void pass_over(results::Sample& sample, double share) noexcept;

  /// read() and respond(). Real-time safe.
  hal::Status exchange(results::Sample& sample) noexcept;
  /// read() and respond_at_rest(). Real-time safe.
  hal::Status hold() noexcept;

  bool has_machine() const noexcept { return machine_ != nullptr; }
  /// Whether the machine's time passes by itself, on the wall clock.
  bool keeps_own_time() const noexcept { return has_machine() && machine_->info().keeps_own_time; }
  /// Servo ready of both axes at the last read().
  bool is_ready() const noexcept { return axis_not_ready() == motion::kNoAxis; }
  /// The first axis without servo ready at the last read(), or kNoAxis.
  std::size_t axis_not_ready() const noexcept;
  /// Inputs of the last read().
  const hal::Inputs& inputs() const noexcept { return inputs_; }
  /// Position of X and Y by the encoder counts of the last period [mm].
  const Vec2& measured() const noexcept { return measured_; }
  /// The first finding of the monitors that ends the motion; nothing as long as all is well.
  const std::optional<motion::Trip>& trip() const noexcept { return trip_; }
  /// Time of the next sample, counted from the first one [s].
  double time() const noexcept { return static_cast<double>(periods_) * period_; }
  /// Returns the trip with time and NC line of this period filled in. Real-time safe.
  motion::Trip stamped(motion::Trip trip) const noexcept;
  /// Writes 0 V and servo off. Not real-time safe.
  void switch_off() noexcept;

 private:
  /// Measured places are from where the machine began; the program's are not.
  Vec2 shifted(const Vec2& measured) const noexcept {
    return is_shifted_ ? Vec2(measured + origin_) : measured;
  }
  Vec2 position_of_counts() const noexcept;
  Vec2 true_position() const noexcept;
  void close_loops() noexcept;
  void ask_servo() noexcept;
  bool is_safe() noexcept;
  bool is_switched_off() const noexcept { return trip_ && is_immediate(*trip_); }
  void keep_in_travel(const motion::SetPoint& last) noexcept;
  bool write() noexcept;
  void fill(results::Sample& sample) const noexcept;

  motion::Interpolator& interpolator_;
  hal::Machine* machine_;
  Servo* servo_;
  double period_;
  Limits limits_;
  std::array<motion::AxisServo, hal::kServoAxes> servos_;
  std::array<bool, hal::kServoAxes> is_saturated_{};
  std::optional<motion::Monitors> monitors_;
  std::optional<motion::Trip> trip_;
  hal::Inputs inputs_{};
  hal::Outputs outputs_{};
  motion::SetPoint set_point_{};
  Vec2 origin_ = Vec2::Zero();  // place at which the counters begin [mm]
  bool is_shifted_ = false;     // it is not 0
  Vec2 measured_ = Vec2::Zero();
  Vec2 torque_ = Vec2::Zero();    // of the motors, if the machine tells it [N.m]
  Vec2 friction_ = Vec2::Zero();  // of the slides, if the machine tells it [N]
  Vec2 table_ = Vec2::Zero();
  double interval_ = 0.0;      // [s]
  double prepare_time_ = 0.0;  // [s]
  double servo_time_ = 0.0;    // [s]
  std::int64_t periods_ = 0;
};

}  // namespace twin::runtime
