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

namespace twin::runtime {

/// One interpolation period of the controller: the next set point, and its exchange with the
/// machine.
///
///   read()       machine.read: counts and switches of this instant
///   prepare()    interpolator -> set point of the period
///   respond()    servo -> monitors -> machine.write
///
/// On the wall clock the calls come in this order, so that the counts are those of the period's
/// begin. In lockstep prepare() comes first and exchange() does the rest, so that a simulated
/// machine lets no time pass in a period that has no set point. The results are the same, because
/// the set point does not depend on what is measured. No call allocates, locks, throws, prints or
/// touches a file, but for what the interpolator's source does in prepare().
///
/// The monitors watch every machine but one that follows its reference exactly. trip() is what they
/// have found. Where it calls for an immediate reaction, the cycle writes 0 V and servo off in the
/// same period and returns kError, and it writes nothing after that.
class Cycle {
 public:
  /// @param machine   configured and active; null for a plan without a machine
  /// @param period    interpolation period T [s]
  /// @param feedrate  largest feedrate of the machine [mm/s]
  Cycle(motion::Interpolator& interpolator, hal::Machine* machine,
        const std::array<motion::Gains, hal::kServoAxes>& gains, double period,
        const motion::SafetySettings& safety = {}, double feedrate = Limits{}.feedrate);

  /// Fetches the inputs. Real-time safe. @param interval since the last read [s]
  hal::Status read(double interval) noexcept;
  /// Fetches the next set point; on anything but kMoving the last one stands. Real-time safe.
  motion::Status prepare() noexcept;
  /// Answers the inputs with the drive commands of the set point. Real-time safe.
  hal::Status respond(results::Sample& sample) noexcept;
  /// The same for the last set point, at rest. Real-time safe.
  hal::Status respond_at_rest() noexcept;
  /// Passes over a set point whose period never began, and writes nothing. The measured values of
  /// the sample lie between those of the period before and those just read. Real-time safe.
  /// @param share  how far between them, 0 to 1
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
  /// Counts and switches as of the last read().
  const hal::Inputs& inputs() const noexcept { return inputs_; }
  /// What the counts mean [mm].
  const Vec2& measured() const noexcept { return measured_; }
  /// What the monitors found first, or what switched the machine off.
  const std::optional<motion::Trip>& trip() const noexcept { return trip_; }
  /// Time of the next sample, since the first one [s].
  double time() const noexcept { return static_cast<double>(periods_) * period_; }
  /// A trip as of this period, about the whole machine or one axis. Real-time safe.
  motion::Trip stamped(motion::Trip trip) const noexcept;
  /// 0 V and servo off. Not real-time safe.
  void switch_off() noexcept;

 private:
  Vec2 position_of_counts() const noexcept;
  Vec2 true_position() const noexcept;
  void close_loops() noexcept;
  bool is_safe() noexcept;
  bool write() noexcept;
  void fill(results::Sample& sample) const noexcept;

  motion::Interpolator& interpolator_;
  hal::Machine* machine_;
  double period_;
  std::array<motion::AxisServo, hal::kServoAxes> servos_;
  std::optional<motion::Monitors> monitors_;
  std::optional<motion::Trip> trip_;
  hal::Inputs inputs_{};
  hal::Outputs outputs_{};
  motion::SetPoint set_point_{};
  Vec2 measured_ = Vec2::Zero();
  Vec2 table_ = Vec2::Zero();
  double interval_ = 0.0;      // [s]
  double prepare_time_ = 0.0;  // [s]
  double servo_time_ = 0.0;    // [s]
  std::int64_t periods_ = 0;
};

}  // namespace twin::runtime
