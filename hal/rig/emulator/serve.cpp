#include "hal/rig/emulator/serve.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

#include <algorithm>
#include <boost/lockfree/spsc_queue.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "core/wall_clock.hpp"
#include "hal/rig/boards/shared_registers.hpp"
#include "hal/rig/emulator/emulated_rig.hpp"
#include "hal/rig/emulator/event_log.hpp"

namespace twin::hal::rig::emulator {
namespace {

constexpr std::int64_t kMostBehind = 20'000'000;  // caught up with at most [ns]
/// An event is told so long after it happened, so that one that is known late still has its place [ns].
constexpr std::int64_t kHeldBack = static_cast<std::int64_t>(1.5 * kRestTime * 1e9);
constexpr std::int64_t kControllerCheck = 1'000'000;  // between looks whether it lives [ns]

std::int64_t nanoseconds(double seconds) noexcept {
  return std::llround(seconds * static_cast<double>(kNsPerS));
}

/// Tells events line by line from a thread of its own, so that a slow terminal or disk does not
/// hold up the plant.
class EventTeller {
 public:
  /// @param tell  gets each line, without its end
  explicit EventTeller(const std::function<void(std::string_view)>& tell);
  /// Tells what is left.
  ~EventTeller() = default;

  /// Hands an event over. False: too many wait, this one is lost. Real-time safe.
  bool push(const Event& event) noexcept { return events_.push(event); }

 private:
  void tell_until(std::int64_t monotonic_ns);

  const std::function<void(std::string_view)>& tell_;
  std::vector<Event> held_;  // until no earlier one can come any more
  boost::lockfree::spsc_queue<Event> events_{4096};
  std::jthread thread_;  // last: ends before what it uses
};

EventTeller::EventTeller(const std::function<void(std::string_view)>& tell)
    : tell_(tell), thread_([this](const std::stop_token& stop) {
        // The plant's thread may be a real-time one; this one need not.
        const sched_param ordinary{};
        pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
        while (!stop.stop_requested()) {
          tell_until(monotonic_ns() - kHeldBack);
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        tell_until(std::numeric_limits<std::int64_t>::max());
      }) {}

void EventTeller::tell_until(std::int64_t monotonic_ns) {
  Event event;
  while (events_.pop(event)) {
    held_.push_back(event);
  }
  held_ = in_order(std::move(held_));
  const auto later = std::ranges::find_if(
      held_, [=](const Event& held) { return held.monotonic_ns > monotonic_ns; });
  for (auto at = held_.begin(); at != later; ++at) {
    tell_(to_string(*at));
  }
  held_.erase(held_.begin(), later);
}

/// The process of the emulator: plant, registers and clock.
class Server {
 public:
  Server(std::unique_ptr<boards::SharedRegisters> shared, const mujoco::TableParams& table,
         const RigSettings& wiring, const ServeSettings& settings,
         const std::function<void(std::string_view)>& tell)
      : shared_(std::move(shared)),
        rig_(table, wiring, settings.faults, &shared_->boards()),
        teller_(tell),
        settings_(settings),
        step_ns_(nanoseconds(settings.step)) {}

  Expected<ServeResult> run(const std::atomic<bool>& stop);

 private:
  Expected<void> advance(std::int64_t now);
  void watch_controller(std::int64_t now);
  void add(EventKind kind, std::int64_t value);
  void tell_events();
  void leave_out(std::int64_t nanoseconds_behind);

  std::unique_ptr<boards::SharedRegisters> shared_;
  EmulatedRig rig_;
  EventTeller teller_;
  const ServeSettings& settings_;
  std::int64_t step_ns_;        // [ns]
  std::int64_t next_ = 0;       // when the next step is due [ns]
  std::int64_t next_look_ = 0;  // when to look whether it lives [ns]
  pid_t controller_ = 0;        // 0: none
  std::size_t told_ = 0;        // events
  ServeResult result_;
};

void Server::add(EventKind kind, std::int64_t value) {
  rig_.events().add({kind, 0, value, rig_.time(), monotonic_ns()});
}

void Server::tell_events() {
  const EventLog& events = rig_.events();
  if (told_ < events.first()) {
    result_.unread_events += events.first() - told_;
    told_ = events.first();
  }
  for (; told_ < events.written(); ++told_) {
    result_.unread_events += teller_.push(events[told_]) ? 0 : 1;
  }
}

void Server::watch_controller(std::int64_t now) {
  const pid_t attached = shared_->block().controller.load();
  if (attached != controller_ && controller_ != 0) {
    add(boards::is_running(controller_) || attached == 0 ? EventKind::kControllerLeft
                                                         : EventKind::kControllerDied,
        controller_);
    controller_ = 0;
  }
  if (attached != 0 && attached != controller_) {
    controller_ = attached;
    add(EventKind::kControllerJoined, attached);
  }
  if (controller_ == 0 || now < next_look_) {
    return;
  }
  next_look_ = now + kControllerCheck;
  if (!boards::is_running(controller_)) {
    add(EventKind::kControllerDied, controller_);
    pid_t dead = std::exchange(controller_, 0);
    shared_->block().controller.compare_exchange_strong(dead, 0);
  }
}

Expected<void> Server::advance(std::int64_t now) {
  boards::SharedBlock& block = shared_->block();
  rig_.set_pen_reference(block.pen_reference.load(std::memory_order_relaxed));
  if (!rig_.advance()) {
    return fail(ErrorCode::kMachine, rig_.last_error());
  }
  const Truth truth = rig_.truth();
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    block.table_position[axis].store(truth.table_position[axis], std::memory_order_relaxed);
  }
  block.plant_time.store(rig_.time(), std::memory_order_relaxed);
  block.monotonic_ns.store(next_, std::memory_order_release);
  ++result_.steps;
  result_.late_steps += now - next_ > step_ns_ ? 1 : 0;
  next_ += step_ns_;
  return {};
}

void Server::leave_out(std::int64_t nanoseconds_behind) {
  const std::int64_t steps = nanoseconds_behind / step_ns_;
  next_ += steps * step_ns_;
  result_.left_out += static_cast<double>(steps) * settings_.step;
  add(EventKind::kFellBehind, steps * step_ns_ / 1'000'000);
}

Expected<ServeResult> Server::run(const std::atomic<bool>& stop) {
  const std::optional<double>& duration = settings_.duration;
  TWIN_CHECK(rig_.power_on(settings_.step));
  shared_->publish();
  if (settings_.started) {
    settings_.started();
  }
  const std::int64_t start = monotonic_ns();
  next_ = start + step_ns_;
  while (!stop.load() && (!duration || next_ - start <= nanoseconds(*duration))) {
    sleep_until_monotonic(next_);
    const std::int64_t now = monotonic_ns();
    if (now < next_) {
      continue;  // a signal
    }
    if (now - next_ > kMostBehind) {
      leave_out(now - next_ - kMostBehind);
    }
    watch_controller(now);
    if (Expected<void> passed = advance(now); !passed) {
      tell_events();
      return tl::unexpected<Error>(passed.error());
    }
    tell_events();
  }
  result_.plant_time = rig_.time();
  result_.lost_edges = rig_.lost_edges();
  return result_;
}

}  // namespace

Expected<ServeResult> serve(const mujoco::TableParams& table, const RigSettings& wiring,
                            const ServeSettings& settings, const std::atomic<bool>& stop,
                            const std::function<void(std::string_view)>& tell) {
  if (!(settings.step >= 1e-5 && settings.step <= 0.1)) {
    return fail(ErrorCode::kUsage,
                fmt::format("step {} s of the emulator is outside 0.00001 to 0.1", settings.step));
  }
  ::prctl(PR_SET_TIMERSLACK, 1UL);  // the default lets sleeps end 50 us late
  TWIN_TRY(std::unique_ptr<boards::SharedRegisters> shared,
           boards::SharedRegisters::create(settings.name.empty() ? boards::default_shared_name()
                                                                 : settings.name));
  return Server(std::move(shared), table, wiring, settings, tell).run(stop);
}

}  // namespace twin::hal::rig::emulator
