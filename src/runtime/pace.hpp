#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "core/wall_clock.hpp"
#include "hal/machine.hpp"
#include "motion/safety/trip.hpp"
#include "results/trace/sample.hpp"
#include "runtime/cycle.hpp"
#include "runtime/inline_planning.hpp"
#include "runtime/pacer.hpp"
#include "runtime/replanning.hpp"
#include "runtime/sample_queue.hpp"

namespace twin::runtime {

/// Timing of the motion: when a period begins, and whether the motion waits for the machine, for
/// planning and for the recorder.
class Pace {
 public:
  Pace() = default;
  Pace(const Pace&) = delete;
  Pace& operator=(const Pace&) = delete;
  virtual ~Pace() = default;

  /// Begins a period.
  virtual hal::Status begin_period(Cycle& cycle) = 0;
  /// Exchanges the set point of the period with the machine.
  virtual hal::Status exchange(Cycle& cycle, results::Sample& sample) noexcept = 0;
  /// Exchanges the last set point with the machine, at rest.
  virtual hal::Status exchange_at_rest(Cycle& cycle) noexcept = 0;
  /// Ends a period that has no set point of the path.
  virtual hal::Status pass_idle(Cycle& cycle) noexcept = 0;

  /// Waits until enough is planned for the motion to start, if the motion may wait.
  /// @returns whether enough is planned
  virtual bool wait_for_segment() noexcept = 0;
  /// Waits until the sample queue has room, if the motion may wait.
  /// @returns whether it has room
  virtual bool wait_for_room(SampleQueue& samples) noexcept = 0;

  /// How late the present period began, and how many were missed before it.
  virtual WakeUp wake_up() const noexcept { return {}; }
  /// A trip if too many periods in a row, or one by far, began too late; else nothing.
  virtual std::optional<motion::Trip> overrun() const noexcept { return std::nullopt; }
  virtual std::int64_t late_periods() const noexcept { return 0; }
  virtual double worst_latency() const noexcept { return 0.0; }  ///< latest begin of a period [s]
};

/// Simulated time: one period follows the other as fast as they can be computed. The motion waits
/// for planning and for the recorder, so the result does not depend on the timing of threads.
///
/// A period begins with the set point. The machine is read in exchange(), where its time passes. So
/// its time stands still while there is no set point.
class LockstepPace final : public Pace {
 public:
  /// @param stop  is set if planning fails
  LockstepPace(InlinePlanning& planning, std::atomic<bool>& stop)
      : planning_(planning), stop_(stop) {}

  hal::Status begin_period(Cycle& /*cycle*/) override { return hal::Status::kOk; }
  hal::Status exchange(Cycle& cycle, results::Sample& sample) noexcept override {
    return cycle.exchange(sample);
  }
  hal::Status exchange_at_rest(Cycle& cycle) noexcept override { return cycle.hold(); }
  hal::Status pass_idle(Cycle& /*cycle*/) noexcept override { return hal::Status::kOk; }
  bool wait_for_segment() noexcept override;
  bool wait_for_room(SampleQueue& samples) noexcept override;

 private:
  InlinePlanning& planning_;
  std::atomic<bool>& stop_;
};

/// The wall clock: each period of the cycle takes one period of the clock, and the motion waits for
/// nothing else.
///
/// A period begins when the clock says so, by reading the machine.
class WallClockPace : public Pace {
 public:
  struct Options {
    double period = 0.001;      ///< [s]
    RealtimeSettings realtime;  ///< when a period is too late
    Schedule schedule = Schedule::kShifted;
    std::function<void(std::int64_t)> before_period;  ///< see TestHooks
  };
  /// @param clock  outlives the pace
  WallClockPace(const PlanSupply& supply, Clock& clock, const Options& options);

  hal::Status begin_period(Cycle& cycle) override;
  hal::Status exchange(Cycle& cycle, results::Sample& sample) noexcept override;
  hal::Status exchange_at_rest(Cycle& cycle) noexcept override { return cycle.respond_at_rest(); }
  hal::Status pass_idle(Cycle& cycle) noexcept override { return cycle.respond_at_rest(); }
  bool wait_for_segment() noexcept override { return supply_.is_primed(); }
  bool wait_for_room(SampleQueue& /*samples*/) noexcept override { return false; }
  WakeUp wake_up() const noexcept override { return wake_up_; }
  std::optional<motion::Trip> overrun() const noexcept override { return pacer_.overrun(); }
  std::int64_t late_periods() const noexcept override { return pacer_.late_periods(); }
  double worst_latency() const noexcept override { return pacer_.worst_latency(); }

 protected:
  /// Takes the wake-up of a period that has begun.
  void begin(const WakeUp& wake_up);
  Pacer& pacer() noexcept { return pacer_; }

 private:
  const PlanSupply& supply_;
  Pacer pacer_;
  std::function<void(std::int64_t)> before_period_;
  WakeUp wake_up_{};
  std::int64_t periods_ = 0;  // begun
};

/// The clock of a machine that gives the beat: as many periods as it has counted, and the time since
/// the last one.
class BeatClock final : public Clock {
 public:
  /// @param period  [s]
  explicit BeatClock(double period) noexcept;

  /// Counts periods that have begun by now. Real-time safe.
  void beat(int periods) noexcept;
  std::int64_t now() noexcept override;
  void sleep_until(std::int64_t /*t*/) noexcept override {}  // read() has waited

 private:
  std::int64_t period_;      // [ns]
  std::int64_t passed_ = 0;  // periods, as a time [ns]
  std::int64_t begun_ = 0;   // the last one, of the wall clock; 0: none [ns]
};

/// The periods of a machine that gives the beat: a period begins when read() returns. All else is as
/// on the wall clock; periods that the controller was too late for are missed.
class BeatPace final : public WallClockPace {
 public:
  /// @param clock  outlives the pace
  BeatPace(const PlanSupply& supply, BeatClock& clock, const Options& options)
      : WallClockPace(supply, clock, options), clock_(clock) {}

  hal::Status begin_period(Cycle& cycle) override;

 private:
  BeatClock& clock_;
};

}  // namespace twin::runtime
