#include "runtime/run_planning.hpp"

#include <utility>

#include "runtime/run_errors.hpp"
#include "runtime/run_options.hpp"

namespace twin::runtime {
namespace {

std::size_t look_ahead_of(const RunRequest& request) {
  return static_cast<std::size_t>(request.machine.path.look_ahead);
}

}  // namespace

LockstepPlanning::LockstepPlanning(const RunRequest& request, ProgramPlanner& planner,
                                   std::atomic<bool>& stop)
    : planning_(planner, request.machine), stop_(stop) {
  planning_.before_segment = request.hooks.before_segment;
}

WallClockPlanning::WallClockPlanning(const RunRequest& request, ProgramPlanner& planner,
                                     std::atomic<bool>& stop)
    : request_(request),
      stop_(stop),
      segments_(look_ahead_of(request), look_ahead_of(request) + 2),
      loop_(planner, segments_, link_, request.machine.path.look_ahead) {
  loop_.before_segment = request.hooks.before_segment;
}

std::unique_ptr<Pace> WallClockPlanning::make_pace() {
  return std::make_unique<WallClockPace>(segments_, clock_, wall_clock_options(request_));
}

void WallClockPlanning::start() {
  thread_ = std::jthread([this] { plan(); });
}

/// Body of the planning thread: nothing escapes, and the motion thread is told the end.
void WallClockPlanning::plan() noexcept {
  try {
    if (auto planned = loop_.run(); !planned) {
      error_ = std::move(planned).error();
    }
  } catch (...) {
    error_ = thrown("planning");
  }
  if (error_) {
    stop_.store(true);
    segments_.close(SegmentQueue::kEveryPlan);
  }
}

std::optional<Error> WallClockPlanning::join() noexcept {
  if (thread_.joinable()) {
    thread_.join();
  }
  return error_;
}

}  // namespace twin::runtime
