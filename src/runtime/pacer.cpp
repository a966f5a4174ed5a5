#include "runtime/pacer.hpp"

#include <algorithm>
#include <cmath>

#include "core/wall_clock.hpp"

namespace twin::runtime {
namespace {

constexpr double kSPerNs = 1e-9;
constexpr std::int64_t kMostMissed = 1'000'000;

}  // namespace

std::int64_t MonotonicClock::now() noexcept { return monotonic_ns(); }

void MonotonicClock::sleep_until(std::int64_t t) noexcept { sleep_until_monotonic(t); }

Pacer::Pacer(Clock& clock, double period, const RealtimeSettings& settings,
             Schedule schedule) noexcept
    : clock_(clock),
      period_(std::llround(period / kSPerNs)),
      schedule_(schedule),
      deadline_(clock.now()),
      intended_(deadline_),
      begun_(deadline_),
      max_in_a_row_(settings.max_late_periods),
      max_stall_(settings.max_stall) {}

WakeUp Pacer::wait() noexcept {
  deadline_ += period_;
  clock_.sleep_until(deadline_);
  const std::int64_t now = clock_.now();
  latency_ = static_cast<double>(now - deadline_) * kSPerNs;
  WakeUp wake_up{latency_, static_cast<double>(now - begun_) * kSPerNs};
  begun_ = now;
  intended_ = deadline_;
  worst_latency_ = std::max(worst_latency_, latency_);
  const std::int64_t missed = (now - deadline_) / period_;
  if (missed < 1) {
    late_in_a_row_ = 0;
    return wake_up;
  }
  ++late_periods_;
  ++late_in_a_row_;
  if (schedule_ == Schedule::kShifted) {
    deadline_ = now;
  } else {
    deadline_ += missed * period_;
    wake_up.missed = static_cast<int>(std::min<std::int64_t>(missed, kMostMissed));
  }
  return wake_up;
}

double Pacer::since_deadline() const noexcept {
  return static_cast<double>(clock_.now() - intended_) * kSPerNs;
}

std::optional<motion::Trip> Pacer::overrun() const noexcept {
  if (latency_ >= max_stall_) {
    return motion::Trip{.kind = motion::Kind::kStall, .value = latency_, .limit = max_stall_};
  }
  if (late_in_a_row_ >= max_in_a_row_) {
    return motion::Trip{.kind = motion::Kind::kLatePeriods,
                        .value = static_cast<double>(late_in_a_row_),
                        .limit = static_cast<double>(max_in_a_row_)};
  }
  return std::nullopt;
}

}  // namespace twin::runtime
