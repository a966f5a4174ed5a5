#include "runtime/pacer.hpp"

#include <algorithm>
#include <cmath>

namespace twin::runtime {
namespace {

constexpr double kSPerNs = 1e-9;

}  // namespace

Pacer::Pacer(Clock& clock, double period, const RealtimeSettings& settings) noexcept
    : clock_(clock),
      period_(std::llround(period / kSPerNs)),
      deadline_(clock.now()),
      begun_(deadline_),
      max_in_a_row_(settings.max_late_periods),
      max_stall_(settings.max_stall) {}

WakeUp Pacer::wait() noexcept {
  deadline_ += period_;
  clock_.sleep_until(deadline_);
  const std::int64_t now = clock_.now();
  latency_ = static_cast<double>(now - deadline_) * kSPerNs;
  const WakeUp wake_up{latency_, static_cast<double>(now - begun_) * kSPerNs};
  begun_ = now;
  worst_latency_ = std::max(worst_latency_, latency_);
  if (now - deadline_ >= period_) {
    ++late_periods_;
    ++late_in_a_row_;
    deadline_ = now;
  } else {
    late_in_a_row_ = 0;
  }
  return wake_up;
}

double Pacer::since_deadline() const noexcept {
  // After a late wake-up the schedule has been shifted; its latency still belongs to the period.
  const double shift = deadline_ == begun_ ? latency_ : 0.0;
  return static_cast<double>(clock_.now() - deadline_) * kSPerNs + shift;
}

std::optional<safety::Trip> Pacer::overrun() const noexcept {
  safety::Trip trip;
  if (latency_ >= max_stall_) {
    trip.kind = safety::Kind::kStall;
    trip.value = latency_;
    trip.limit = max_stall_;
  } else if (late_in_a_row_ >= max_in_a_row_) {
    trip.kind = safety::Kind::kLatePeriods;
    trip.value = late_in_a_row_;
    trip.limit = max_in_a_row_;
  } else {
    return std::nullopt;
  }
  trip.reaction = safety::reaction_to(trip.kind);
  return trip;
}

}  // namespace twin::runtime
