#include "runtime/inline_planning.hpp"

#include <cassert>
#include <limits>
#include <utility>

#include "feedrate/profile/phases.hpp"
#include "runtime/run_errors.hpp"

namespace twin::runtime {
namespace {

// Of the quickest stop from the largest feedrate. The planner may leave less acceleration for
// braking in a corner, so one is not enough; each one more costs memory for the segments on it.
constexpr double kBrakingDistances = 4.0;

}  // namespace

InlinePlanning::InlinePlanning(ProgramPlanner& planner, const config::MachineFile& machine)
    : planner_(planner), most_ahead_(static_cast<std::size_t>(machine.path.look_ahead)) {
  const Limits& limits = machine.limits;
  length_ahead_ = kBrakingDistances *
                  feedrate::make_brake({.s = 0.0, .v = limits.feedrate, .a = limits.acceleration},
                                       {.acceleration = limits.acceleration, .jerk = limits.jerk})
                      .distance;
}

Expected<void> InlinePlanning::plan_on() {
  TWIN_CHECK(planner_.plan_ahead(most_ahead_, length_ahead_));
  while (before_segment &&
         announced_ < handed_out_ + static_cast<std::int64_t>(planner_.waiting())) {
    before_segment(announced_++);
  }
  return {};
}

bool InlinePlanning::plan_ahead() noexcept {
  if (error_) {
    return false;
  }
  try {
    if (auto planned = plan_on(); !planned) {
      error_ = std::move(planned).error();
    }
  } catch (...) {
    error_ = thrown("planning");
  }
  return !error_;
}

const feedrate::PlannedSegment* InlinePlanning::next() noexcept {
  while (planner_.waiting() > 0 || (plan_ahead() && planner_.waiting() > 0)) {
    feedrate::PlannedSegment segment = std::move(planner_.front());
    planner_.pop_front();
    ++handed_out_;
    if (segment.plan == plan_) {
      followed_.push_back(std::move(segment));
      return &followed_.back();
    }
  }
  return nullptr;
}

void InlinePlanning::release([[maybe_unused]] const feedrate::PlannedSegment* segment) noexcept {
  assert(segment == &followed_.front());
  followed_.pop_front();
}

bool InlinePlanning::is_finished() const noexcept {
  return planner_.waiting() == 0 && (planner_.is_all_planned() || error_);
}

double InlinePlanning::reach(std::int64_t /*plan*/) const noexcept {
  return std::numeric_limits<double>::infinity();
}

bool InlinePlanning::ask(const ReplanRequest& request) noexcept {
  if (error_) {
    return false;
  }
  try {
    request_ = request;
    if (auto made = planner_.offer(request)) {
      offer_ = *made;
    } else {
      error_ = std::move(made).error();
    }
  } catch (...) {
    error_ = thrown("planning");
  }
  return !error_;
}

void InlinePlanning::answer(Verdict verdict) noexcept {
  planner_.conclude(*offer_, request_, verdict);
  offer_.reset();
}

}  // namespace twin::runtime
